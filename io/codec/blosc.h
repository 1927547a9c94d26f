// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks Blosc 1 by its library.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace mw::io {

/// name: what errors call the bytes.
/// Memory: at most four times `most` bytes, and 64 KiB: the library works on whole blocks, and a
/// block may be all there is.  Thread safety: any; no state of the library is shared.
/// ERRORS: mw::Error(kInput) for damage, truncation and more than `most` bytes.
[[nodiscard]] std::vector<std::byte> unpack_blosc(std::span<const std::byte> packed,
                                                  std::size_t max, std::string_view name);

}  // namespace mw::io
