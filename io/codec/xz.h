// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks .xz (LZMA2 in its container) by liblzma.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace mw::io {

/// What the decoder may take for itself: preset 9, the largest, has a dictionary of 64 MiB.  Of a
/// dictionary only as much is touched as comes out.
inline constexpr std::uint64_t kMaxXzBytes = std::uint64_t{80} << 20U;

/// One or several streams.  name: what errors call the bytes.
/// Memory: what comes out, at most `most` bytes, and kMaxXzBytes.  Thread safety: any.
/// ERRORS: mw::Error(kInput) for damage, truncation and more than `most` bytes.
[[nodiscard]] std::vector<std::byte> unpack_xz(std::span<const std::byte> packed, std::size_t max,
                                               std::string_view name);

}  // namespace mw::io
