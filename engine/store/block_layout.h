// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers that both sides of the block codec share; the layout itself is told in block_codec.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mw::engine {

inline constexpr std::uint64_t kBlockMagic = 0x0242574DU;  ///< "MWB", version 2
inline constexpr std::size_t kBlockHeadBytes = 16;
inline constexpr std::size_t kBlockSumAt = 4;
inline constexpr std::size_t kBlockSizeAt = 8;  ///< here the checksummed part begins
inline constexpr std::uint64_t kSameAsFirst = 9;
inline constexpr unsigned kDoubleBytes = 8;

/// The ten doubles of a quadric (a, b, c) bit by bit.
using QuadricBits = std::array<std::uint64_t, 10>;

}  // namespace mw::engine
