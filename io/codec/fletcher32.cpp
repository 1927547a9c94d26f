// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Fletcher's checksum: a sum, and a sum of sums, in ones' complement.
#include "io/codec/checksums.h"

namespace mw::io {
namespace {

/// The same modulo 65535; never 0 for what is not 0, as the sums of the definition never are.
std::uint32_t folded(std::uint32_t sum) {
  return (sum & 0xffffU) + (sum >> 16U);
}

}  // namespace

std::uint32_t fletcher32(std::span<const std::byte> bytes) {
  std::uint32_t sum = 0, sums = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 2) {
    const auto upper = std::to_integer<std::uint32_t>(bytes[at]);
    const auto lower = at + 1 < bytes.size() ? std::to_integer<std::uint32_t>(bytes[at + 1]) : 0U;
    sum = folded(sum + ((upper << 8U) | lower));
    sums = folded(sums + sum);
  }
  return (folded(sums) << 16U) | folded(sum);
}

}  // namespace mw::io
