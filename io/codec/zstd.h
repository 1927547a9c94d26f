// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks Zstandard (RFC 8878) by libzstd.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace mw::io {

/// One or several frames, with or without their content size.  name: what errors call the bytes.
/// Memory: at most `most` bytes, and 200 KiB.  Thread safety: any.
/// ERRORS: mw::Error(kInput) for damage, truncation and more than `most` bytes.
[[nodiscard]] std::vector<std::byte> unpack_zstd(std::span<const std::byte> packed, std::size_t max,
                                                 std::string_view name);

}  // namespace mw::io
