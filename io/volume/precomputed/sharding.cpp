// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds chunks in shards, and reads them.
#include "io/volume/precomputed/sharding.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

#include "io/chunks/chunk.h"
#include "io/codec/codec.h"
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

namespace {

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

namespace {

/// The bytes of indices that are kept, enough for those around a window: 512 chunks take 12 KiB.
constexpr std::uint64_t kKeptIndexBytes = 4ULL << 20U;

/// Chunks of a minishard come in any order, as the differences between them may wrap.
std::optional<ShardEntry> entry_of(const Chunk& index, std::uint64_t chunk) {
  ShardEntry entry;
  for (std::size_t at = 0; at < index.bytes.size(); at += sizeof entry) {
    std::memcpy(&entry, index.bytes.data() + at, sizeof entry);
    if (entry.chunk == chunk) return entry;
  }
  return std::nullopt;
}

/// Before 2019 a shard was two files, <shard>.index and <shard>.data.
void refuse_old_shard(const Place& folder, std::string shard) {
  shard.replace(shard.rfind(".shard"), shard.npos, ".index");
  const Place index = folder / shard;
  if (!index.is_file()) return;
  fail_input(index.string(), {}, "the shard is of an old form, an index and data apart",
             "join the two to a file with .shard instead of .index");
}

std::vector<std::byte> read_part(const ByteSource& file, std::uint64_t offset, std::uint64_t size) {
  std::vector<std::byte> bytes(size);
  file.read_at(offset, bytes);
  return bytes;
}

}  // namespace

ShardFolder::ShardFolder(Place folder, const Sharding& sharding, Index3 grid)
    : folder_(std::move(folder)),
      sharding_(sharding),
      max_index_bytes_(sizeof(ShardEntry) * max_in_minishard(sharding, grid)),
      indices_(kKeptIndexBytes) {}

Place ShardFolder::path_of(std::uint64_t chunk) const {
  return folder_ / shard_file_name(sharding_, position_of(sharding_, chunk).shard);
}

std::shared_ptr<const ByteSource> ShardFolder::find(std::uint64_t chunk, std::string name,
                                                    std::uint64_t max) const {
  const ShardPosition position = position_of(sharding_, chunk);
  const Place path = path_of(chunk);
  const std::uint64_t number =
      position.shard << static_cast<unsigned>(sharding_.minishard_bits) | position.minishard;
  const auto index = indices_.get(number, [&] { return load_index(path, position.minishard); });
  if (!index) return nullptr;
  const auto entry = entry_of(*index, chunk);
  if (!entry) return nullptr;
  if (entry->size > max) {
    fail_input(path.string(), text("chunk ", chunk),
               text("the chunk has ", entry->size, " bytes, and its voxels need at most ", max),
               "get a whole copy of the store");
  }
  // The index was compared with the file's size when it was read.
  return path.open_part(shard_index_bytes(sharding_) + entry->offset, entry->size, std::move(name));
}

std::optional<Chunk> ShardFolder::load_index(const Place& path, std::uint64_t minishard) const {
  const auto file = path.open_parts_if_there();
  if (!file) {
    refuse_old_shard(folder_, path.last_part());
    return std::nullopt;
  }
  const std::uint64_t start = shard_index_bytes(sharding_);
  std::array<std::byte, 16> entry{};
  file->read_at(entry.size() * minishard, entry);
  const auto begin = load<std::uint64_t>(entry.data(), ByteOrder::kLittle);
  const auto end = load<std::uint64_t>(entry.data() + 8, ByteOrder::kLittle);
  if (begin == end) return std::nullopt;
  const std::string name = text(path.string(), ": minishard ", minishard);
  const std::uint64_t data_bytes = file->size() > start ? file->size() - start : 0;
  if (begin > end || end > data_bytes) {
    fail_input(name, "shard index",
               text("bytes ", begin, " to ", end, " are not in the ", data_bytes, " of the shard"),
               "get a whole copy of the store");
  }
  const std::uint64_t max =
      sharding_.packed_index ? max_packed_bytes(max_index_bytes_) : max_index_bytes_;
  if (end - begin > max) {
    fail_input(name, "shard index",
               text("an index of ", end - begin, " bytes, and all its chunks need at most ", max),
               "get a whole copy of the store");
  }
  std::vector<std::byte> bytes = read_part(*file, start + begin, end - begin);
  if (sharding_.packed_index) bytes = unpack(Codec::kGzip, bytes, max_index_bytes_, name);
  const auto entries = parse_minishard_index(bytes, data_bytes, name);
  const auto raw = std::as_bytes(std::span(entries));
  return Chunk{.bytes = {raw.begin(), raw.end()}};
}

std::uint64_t ShardFolder::scratch_bytes() const {
  return kKeptIndexBytes + max_packed_bytes(max_index_bytes_) + 3 * max_index_bytes_ +
         max_scratch(Codec::kGzip, max_index_bytes_);
}

}  // namespace mw::io
