// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks LZF, h5py's filter.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace mw::io {

/// A stream of LibLZF without a header.  name: what errors call the bytes.
/// Memory: what comes out, at most `most` bytes.  Thread safety: any.
/// ERRORS: mw::Error(kInput) for damage, truncation and more than `most` bytes.
[[nodiscard]] std::vector<std::byte> unpack_lzf(std::span<const std::byte> packed, std::size_t max,
                                                std::string_view name);

}  // namespace mw::io
