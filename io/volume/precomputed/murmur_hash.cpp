// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// MurmurHash3_x86_128 of 8 bytes: they fill no block of 16, so that all of them are its tail.
#include "io/volume/precomputed/murmur_hash.h"

#include <array>
#include <bit>

namespace mw::io {
namespace {

constexpr std::uint32_t kC1 = 0x239b961b;
constexpr std::uint32_t kC2 = 0xab0e9789;
constexpr std::uint32_t kC3 = 0x38b34ae5;
constexpr std::uint32_t kLength = 8;

/// Lets every bit of h depend on every other.
constexpr std::uint32_t avalanche(std::uint32_t h) {
  h = (h ^ (h >> 16U)) * 0x85ebca6b;
  h = (h ^ (h >> 13U)) * 0xc2b2ae35;
  return h ^ (h >> 16U);
}

using State = std::array<std::uint32_t, 4>;

void add_up(State& h) {
  h[0] += h[1] + h[2] + h[3];
  for (const std::size_t i : {1U, 2U, 3U}) h[i] += h[0];
}

}  // namespace

std::uint64_t murmur_hash(std::uint64_t key) {
  const auto low = static_cast<std::uint32_t>(key);
  const auto high = static_cast<std::uint32_t>(key >> 32U);
  State h{std::rotl(low * kC1, 15) * kC2, std::rotl(high * kC2, 16) * kC3, 0, 0};
  for (std::uint32_t& part : h) part ^= kLength;
  add_up(h);
  for (std::uint32_t& part : h) part = avalanche(part);
  add_up(h);
  return std::uint64_t{h[1]} << 32U | h[0];
}

}  // namespace mw::io
