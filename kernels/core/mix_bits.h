// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers whose bits all depend on all bits of a key.
#pragma once

#include <cstdint>
#include <string_view>

namespace mw {

/// Bijective mixing of 64 bits (the finaliser of splitmix64).
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// Mixes a text into a hash of what came before it.
[[nodiscard]] constexpr std::uint64_t mix_text(std::string_view text, std::uint64_t before = 0) {
  std::uint64_t hash = mix_bits(before ^ text.size());
  for (const char c : text) hash = mix_bits(hash ^ static_cast<unsigned char>(c));
  return hash;
}

}  // namespace mw
