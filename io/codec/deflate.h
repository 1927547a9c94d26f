// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks gzip (RFC 1952) and zlib (RFC 1950) by zlib.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace mw::io {

/// One or several members, behind which zeros may fill up.  name: what errors call the bytes.
/// Memory: what comes out, at most `most` bytes, and 64 KiB.  Thread safety: any.
/// ERRORS: mw::Error(kInput) for damage, truncation and more than `most` bytes.
[[nodiscard]] std::vector<std::byte> unpack_gzip(std::span<const std::byte> packed, std::size_t max,
                                                 std::string_view name);

/// The same for zlib's framing.
[[nodiscard]] std::vector<std::byte> unpack_zlib(std::span<const std::byte> packed, std::size_t max,
                                                 std::string_view name);

}  // namespace mw::io
