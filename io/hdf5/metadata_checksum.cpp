// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bob Jenkins' lookup3.c (2006, public domain), hashlittle(), byte by byte.
#include "io/hdf5/metadata_checksum.h"

#include <array>
#include <bit>

namespace mw::io {
namespace {

using State = std::array<std::uint32_t, 3>;

void mix(State& s) {
  auto& [a, b, c] = s;
  a -= c, a ^= std::rotl(c, 4), c += b;
  b -= a, b ^= std::rotl(a, 6), a += c;
  c -= b, c ^= std::rotl(b, 8), b += a;
  a -= c, a ^= std::rotl(c, 16), c += b;
  b -= a, b ^= std::rotl(a, 19), a += c;
  c -= b, c ^= std::rotl(b, 4), b += a;
}

void finish(State& s) {
  auto& [a, b, c] = s;
  c ^= b, c -= std::rotl(b, 14);
  a ^= c, a -= std::rotl(c, 11);
  b ^= a, b -= std::rotl(a, 25);
  c ^= b, c -= std::rotl(b, 16);
  a ^= c, a -= std::rotl(c, 4);
  b ^= a, b -= std::rotl(a, 14);
  c ^= b, c -= std::rotl(b, 24);
}

/// Up to twelve bytes, least significant first.
void add(std::string_view bytes, State& s) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    s[i / 4] += std::uint32_t{static_cast<unsigned char>(bytes[i])} << 8 * (i % 4);
  }
}

}  // namespace

std::uint32_t metadata_checksum(std::string_view bytes) {
  constexpr std::size_t kStep = 12;
  const std::uint32_t start = 0xdeadbeef + static_cast<std::uint32_t>(bytes.size());
  State s{start, start, start};
  if (bytes.empty()) return s[2];
  for (; bytes.size() > kStep; bytes.remove_prefix(kStep)) {
    add(bytes.substr(0, kStep), s);
    mix(s);
  }
  add(bytes, s);
  finish(s);
  return s[2];
}

}  // namespace mw::io
