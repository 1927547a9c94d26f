// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where chunks are in shards.
#include "io/volume/precomputed/sharding.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>

#include "io/chunks/chunk.h"
#include "io/file/byte_order.h"
#include "io/file/errors.h"

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

/// Returns how many bits the places 0 to extent - 1 need.
int bits_of(std::int64_t extent) {
  return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(extent - 1)));
}

/// Shifts right, also by 64 and more, which C++ leaves undefined.
std::uint64_t shifted(std::uint64_t value, int bits) {
  return bits > 63 ? 0 : value >> static_cast<unsigned>(bits);
}

std::uint64_t low_bits(std::uint64_t value, int bits) {
  return bits > 63 ? value : value & ((std::uint64_t{1} << static_cast<unsigned>(bits)) - 1);
}

std::uint64_t power_of_two(int bits) {
  return std::uint64_t{1} << static_cast<unsigned>(bits);
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

std::uint64_t morton_code(Index3 cell, Index3 grid) {
  const std::array<std::int64_t, 3> index{cell.x, cell.y, cell.z};
  const std::array<int, 3> bits{bits_of(grid.x), bits_of(grid.y), bits_of(grid.z)};
  std::uint64_t code = 0;
  unsigned next = 0;
  for (int bit = 0; bit < *std::max_element(bits.begin(), bits.end()); ++bit) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (bit >= bits[axis]) continue;
      code |= (static_cast<std::uint64_t>(index[axis]) >> static_cast<unsigned>(bit) & 1U) << next;
      ++next;
    }
  }
  return code;
}

ShardPosition position_of(const Sharding& sharding, std::uint64_t chunk) {
  const std::uint64_t group = shifted(chunk, sharding.preshift_bits);
  const std::uint64_t hash = sharding.hashed ? murmur_hash(group) : group;
  return {.shard = low_bits(shifted(hash, sharding.minishard_bits), sharding.shard_bits),
          .minishard = low_bits(hash, sharding.minishard_bits)};
}

std::string shard_file_name(const Sharding& sharding, std::uint64_t shard) {
  std::array<char, 16> digits{};
  char* end = std::to_chars(digits.data(), digits.data() + digits.size(), shard, 16).ptr;
  const std::string number(digits.data(), end);
  const auto wanted = static_cast<std::size_t>((sharding.shard_bits + 3) / 4);
  const std::size_t zeros = wanted > number.size() ? wanted - number.size() : 0;
  return std::string(zeros, '0') + number + ".shard";
}

std::uint64_t shard_index_bytes(const Sharding& sharding) {
  constexpr std::uint64_t kEntryBytes = 16;
  return kEntryBytes << static_cast<unsigned>(sharding.minishard_bits);
}

std::uint64_t max_in_minishard(const Sharding& sharding, Index3 grid) {
  const int bits = bits_of(grid.x) + bits_of(grid.y) + bits_of(grid.z);
  const int within = std::min(bits, sharding.preshift_bits);
  const int left = std::max(0, bits - within - sharding.minishard_bits - sharding.shard_bits);
  std::uint64_t groups = power_of_two(left);
  if (sharding.hashed) groups = std::min(8 * groups + 64, power_of_two(bits - within));
  return std::min(groups << static_cast<unsigned>(within),
                  static_cast<std::uint64_t>(grid.product()));
}

std::vector<ShardEntry> parse_minishard_index(std::span<const std::byte> bytes,
                                              std::uint64_t data_bytes, std::string_view name) {
  constexpr std::size_t kColumnBytes = 24;
  if (bytes.size() % kColumnBytes != 0) {
    fail_input(name, "minishard index", text(bytes.size(), " bytes are not a multiple of 24"),
               "get a whole copy of the store");
  }
  const std::size_t count = bytes.size() / kColumnBytes;
  const auto at = [&](std::size_t row, std::size_t column) {
    return load<std::uint64_t>(bytes.data() + 8 * (row * count + column), ByteOrder::kLittle);
  };
  std::vector<ShardEntry> entries(count);
  ShardEntry last;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t gap = at(1, i);
    const std::uint64_t left = data_bytes - last.offset - last.size;
    last = {
        .chunk = last.chunk + at(0, i), .offset = last.offset + last.size + gap, .size = at(2, i)};
    if (gap > left || last.size > left - gap) {
      fail_input(name, "minishard index",
                 text("entry ", i, " (chunk ", last.chunk, ") leads beyond the end of the file"),
                 "get a whole copy of the store");
    }
    entries[i] = last;
  }
  return entries;
}

}  // namespace mw::io
