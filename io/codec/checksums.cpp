// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// CRC-32C, XXH32 and Fletcher's checksum.
#include "io/codec/checksums.h"

#include <zlib.h>

#include <array>
#include <bit>

#include "io/file/byte_order.h"

namespace mw::io {
namespace {

constexpr std::uint32_t kPolynomial = 0x82f63b78;  // lowest bit first

constexpr std::array<std::uint32_t, 256> table() {
  std::array<std::uint32_t, 256> out{};
  for (std::uint32_t byte = 0; byte < out.size(); ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) {
      rest = (rest >> 1U) ^ ((rest & 1U) != 0 ? kPolynomial : 0);
    }
    out[byte] = rest;
  }
  return out;
}

constexpr std::array<std::uint32_t, 256> kTable = table();

constexpr std::uint32_t kPrime1 = 0x9e3779b1, kPrime2 = 0x85ebca77, kPrime3 = 0xc2b2ae3d,
                        kPrime4 = 0x27d4eb2f, kPrime5 = 0x165667b1;
constexpr std::size_t kStripeBytes = 16;

std::uint32_t word(std::span<const std::byte> bytes, std::size_t at) {
  return load<std::uint32_t>(bytes.data() + at, ByteOrder::kLittle);
}

/// Takes whole stripes off the front of bytes.
std::uint32_t converge_stripes(std::span<const std::byte>& bytes, std::uint32_t seed) {
  std::array<std::uint32_t, 4> lanes{seed + kPrime1 + kPrime2, seed + kPrime2, seed,
                                     seed - kPrime1};
  for (; bytes.size() >= kStripeBytes; bytes = bytes.subspan(kStripeBytes)) {
    for (std::size_t i = 0; i < 4; ++i) {
      lanes[i] = std::rotl(lanes[i] + word(bytes, 4 * i) * kPrime2, 13) * kPrime1;
    }
  }
  return std::rotl(lanes[0], 1) + std::rotl(lanes[1], 7) + std::rotl(lanes[2], 12) +
         std::rotl(lanes[3], 18);
}

/// Folds a sum to one that is equal modulo 65535, and 0 only if the sum is, as the definition does.
std::uint32_t folded(std::uint32_t sum) {
  return (sum & 0xffffU) + (sum >> 16U);
}

}  // namespace

std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before) {
  std::uint32_t rest = ~before;
  for (const std::byte byte : bytes) {
    rest = (rest >> 8U) ^ kTable[(rest ^ std::to_integer<std::uint32_t>(byte)) & 0xffU];
  }
  return ~rest;
}

std::uint32_t xxhash32(std::span<const std::byte> bytes, std::uint32_t seed) {
  const auto length = static_cast<std::uint32_t>(bytes.size());
  std::uint32_t hash =
      bytes.size() >= kStripeBytes ? converge_stripes(bytes, seed) : seed + kPrime5;
  hash += length;
  for (; bytes.size() >= 4; bytes = bytes.subspan(4)) {
    hash = std::rotl(hash + word(bytes, 0) * kPrime3, 17) * kPrime4;
  }
  for (const std::byte byte : bytes) {
    hash = std::rotl(hash + std::to_integer<std::uint32_t>(byte) * kPrime5, 11) * kPrime1;
  }
  hash = (hash ^ (hash >> 15U)) * kPrime2;
  hash = (hash ^ (hash >> 13U)) * kPrime3;
  return hash ^ (hash >> 16U);
}

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

std::uint32_t checksum(std::span<const std::byte> bytes) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
  return static_cast<std::uint32_t>(crc32_z(0, data, bytes.size()));
}

}  // namespace mw::io
