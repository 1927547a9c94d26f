// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Random numbers without state: a number for each key.
#pragma once

#include <cstdint>

#include "kernels/core/index.h"
#include "kernels/core/mix_bits.h"

namespace mw {

__extension__ using Wide = unsigned __int128;

/// A number for a place (each coordinate below 2^21), the same in every run.
[[nodiscard]] constexpr std::uint64_t hash_position(std::uint64_t seed, Index3 position) {
  const auto part = [](std::int64_t i) { return static_cast<std::uint64_t>(i) & 0x1fffffU; };
  const std::uint64_t key = part(position.x) | part(position.y) << 21 | part(position.z) << 42;
  return mix_bits(key ^ mix_bits(seed));
}

/// An integer in lo .. hi-1 from a hash; the bias is below (hi - lo) / 2^32.
[[nodiscard]] constexpr std::int64_t pick(std::uint64_t hash, std::int64_t lo, std::int64_t hi) {
  const auto range = static_cast<std::uint64_t>(hi - lo);
  return lo + static_cast<std::int64_t>(((hash >> 32) * range) >> 32);
}

}  // namespace mw
