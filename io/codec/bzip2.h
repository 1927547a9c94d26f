// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks bzip2 by libbz2.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace mw::io {

/// One or several streams.  name: what errors call the bytes.
/// Memory: what comes out, at most `most` bytes, and 4 MiB.  Thread safety: any.
/// ERRORS: mw::Error(kInput) for damage, truncation and more than `most` bytes.
[[nodiscard]] std::vector<std::byte> unpack_bzip2(std::span<const std::byte> packed,
                                                  std::size_t max, std::string_view name);

}  // namespace mw::io
