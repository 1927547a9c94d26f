// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A writer of precomputed volumes, after the format's description and by no code of the reader.
#pragma once

#include "tests/io/volume/volume_checks.h"

namespace mw::io {

/// MurmurHash3_x86_128 of any bytes, in the form in which it is published.
inline std::array<std::uint32_t, 4> murmur_reference(const std::string& bytes, std::uint32_t seed) {
  constexpr std::array<std::uint32_t, 4> kFactor{0x239b961bU, 0xab0e9789U, 0x38b34ae5U,
                                                 0xa1e38b93U};
  constexpr std::array<int, 4> kTurnKey{15, 16, 17, 18}, kTurnHash{19, 17, 15, 13};
  constexpr std::array<std::uint32_t, 4> kPlus{0x561ccd1bU, 0x0bcaa747U, 0x96cd1c35U, 0x32ac3b17U};
  std::array<std::uint32_t, 4> h{seed, seed, seed, seed};
  const auto mixed = [&](std::uint32_t k, std::size_t i) {
    return std::rotl(k * kFactor[i], kTurnKey[i]) * kFactor[(i + 1) % 4];
  };
  std::string rest = bytes;
  for (; rest.size() >= 16; rest = rest.substr(16)) {
    for (std::size_t i = 0; i < 4; ++i) {
      std::uint32_t k = 0;
      std::memcpy(&k, rest.data() + 4 * i, 4);
      h[i] = std::rotl(h[i] ^ mixed(k, i), kTurnHash[i]) + h[(i + 1) % 4];
      h[i] = h[i] * 5 + kPlus[i];
    }
  }
  const std::string tail = rest + std::string(16 - rest.size(), '\0');
  for (std::size_t i = 0; i < 4; ++i) {
    std::uint32_t k = 0;
    std::memcpy(&k, tail.data() + 4 * i, 4);
    h[i] ^= mixed(k, i);
  }
  const auto sum = [&] {
    h[0] += h[1] + h[2] + h[3];
    h[1] += h[0];
    h[2] += h[0];
    h[3] += h[0];
  };
  for (std::uint32_t& x : h) x ^= static_cast<std::uint32_t>(bytes.size());
  sum();
  for (std::uint32_t& x : h) {
    x ^= x >> 16;
    x *= 0x85ebca6bU;
    x ^= x >> 13;
    x *= 0xc2b2ae35U;
    x ^= x >> 16;
  }
  sum();
  return h;
}

/// The compressed Morton code: bits of x, y and z in turn, written down from the lowest on.
inline std::uint64_t morton_reference(Index3 cell, Index3 grid) {
  std::string lowest_first;
  for (int i = 0; i < 21; ++i) {
    const std::int64_t bit = std::int64_t{1} << i;
    if (bit < grid.x) lowest_first += (cell.x & bit) != 0 ? '1' : '0';
    if (bit < grid.y) lowest_first += (cell.y & bit) != 0 ? '1' : '0';
    if (bit < grid.z) lowest_first += (cell.z & bit) != 0 ? '1' : '0';
  }
  std::reverse(lowest_first.begin(), lowest_first.end());
  return lowest_first.empty() ? 0 : std::stoull(lowest_first, nullptr, 2);
}

/// A chunk of labels in compressed_segmentation.  Some blocks take more bits than they need, some
/// have their table first: readers must not care.
inline std::string encode_segmentation(Random& random, const std::vector<RawLabel>& labels,
                                       Index3 shape, Index3 block, int voxel_bytes) {
  std::vector<std::uint32_t> words;
  const auto blocks = [](std::int64_t n, std::int64_t b) { return (n + b - 1) / b; };
  const Index3 grid{blocks(shape.x, block.x), blocks(shape.y, block.y), blocks(shape.z, block.z)};
  words.resize(2 * static_cast<std::size_t>(grid.product()));
  std::size_t header = 0;
  each_chunk(shape, block, [&](Index3, const Box3& box) {
    const std::vector<RawLabel> inside = part_of(labels, shape, box);
    const std::set<RawLabel> distinct(inside.begin(), inside.end());
    const std::vector<RawLabel> table(distinct.begin(), distinct.end());
    std::uint32_t bits = 0;
    for (const std::uint32_t more : {1U, 2U, 4U, 8U, 16U, 32U}) {
      const bool needed = bits < 32 && table.size() > (std::uint64_t{1} << bits);
      if (needed || random() % 30 == 0) bits = more;
    }
    std::vector<std::uint32_t> values((static_cast<std::size_t>(block.product()) * bits + 31) / 32);
    for (std::size_t i = 0; i < inside.size() && bits > 0; ++i) {
      const Index3 s = box.shape();
      const auto n = static_cast<std::int64_t>(i);
      const auto at =
          static_cast<std::size_t>(n % s.x + block.x * (n / s.x % s.y + block.y * (n / s.x / s.y)));
      const auto index = static_cast<std::uint32_t>(
          std::find(table.begin(), table.end(), inside[i]) - table.begin());
      values[at * bits / 32] |= index << at * bits % 32;
    }
    const auto add_table = [&] {
      words[header] = static_cast<std::uint32_t>(words.size()) | bits << 24;
      for (const RawLabel label : table) {
        words.push_back(static_cast<std::uint32_t>(label));
        if (voxel_bytes == 8) words.push_back(static_cast<std::uint32_t>(label >> 32));
      }
    };
    const bool table_first = random() % 2 == 0;
    if (table_first) add_table();
    words[header + 1] = static_cast<std::uint32_t>(words.size());
    words.insert(words.end(), values.begin(), values.end());
    if (!table_first) add_table();
    header += 2;
  });
  std::string bytes = number_bytes(1, 4, false);
  for (const std::uint32_t word : words) bytes += number_bytes(word, 4, false);
  return bytes;
}

struct ShardingSample {
  bool hashed = false;
  int preshift = 0;
  int minishard = 0;
  int shard = 0;
  bool packed_index = false;
  bool packed_data = false;
};

struct PrecomputedSample {
  Index3 shape{7, 6, 5};
  Index3 chunk{4, 4, 4};
  Index3 offset{0, 0, 0};
  VoxelType type = VoxelType::kU32;
  std::optional<Index3> block;  ///< of compressed_segmentation
  enum Packing { kPlain, kGzipped, kGzippedWithEnding } packing = kPlain;
  std::optional<ShardingSample> sharding;
  std::string key = "8_8_40";
  std::string resolution = "[8, 8, 40]";

  [[nodiscard]] std::string info() const {
    const auto triple = [](Index3 v) {
      return "[" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) +
             "]";
    };
    std::string scale = R"({"key": ")" + key + R"(", "size": )" + triple(shape) +
                        R"(, "voxel_offset": )" + triple(offset) + R"(, "resolution": )" +
                        resolution + R"(, "chunk_sizes": [)" + triple(chunk) + "]";
    scale += block ? R"(, "encoding": "compressed_segmentation", )"
                     R"("compressed_segmentation_block_size": )" +
                         triple(*block)
                   : R"(, "encoding": "raw")";
    if (sharding) scale += R"(, "sharding": )" + sharding_json();
    return R"({"@type": "neuroglancer_multiscale_volume", "type": "segmentation", "data_type": ")" +
           type_name() + R"(", "num_channels": 1, "scales": [)" + scale + "}]}";
  }

  /// Chunks whose labels are all 0 are not written.
  void write(Random& random, const std::filesystem::path& folder,
             const std::vector<RawLabel>& labels) const {
    write_file(folder / "info", info());
    std::filesystem::create_directories(folder / key);
    std::map<std::uint64_t, std::string> chunks;
    each_chunk(shape, chunk, [&](Index3 number, const Box3& box) {
      const std::vector<RawLabel> inside = part_of(labels, shape, box);
      if (std::all_of(inside.begin(), inside.end(), [](RawLabel l) { return l == 0; })) return;
      const std::string bytes =
          block ? encode_segmentation(random, inside, box.shape(), *block, byte_size(type))
                : voxel_bytes(inside, type, false);
      if (!sharding) return write_chunk(folder / key / chunk_name(box), bytes);
      const auto parts = [](std::int64_t n, std::int64_t c) { return (n + c - 1) / c; };
      const Index3 grid{parts(shape.x, chunk.x), parts(shape.y, chunk.y), parts(shape.z, chunk.z)};
      chunks[morton_reference(number, grid)] = bytes;
    });
    if (sharding) write_shards(random, folder / key, chunks);
  }

  [[nodiscard]] std::string chunk_name(const Box3& box) const {
    const auto range = [](std::int64_t lo, std::int64_t hi) {
      return std::to_string(lo) + "-" + std::to_string(hi);
    };
    return range(offset.x + box.lo.x, offset.x + box.hi.x) + "_" +
           range(offset.y + box.lo.y, offset.y + box.hi.y) + "_" +
           range(offset.z + box.lo.z, offset.z + box.hi.z);
  }

 private:
  [[nodiscard]] std::string type_name() const {
    const std::string bits = std::to_string(8 * byte_size(type));
    if (is_float(type)) return "float" + bits;
    return (is_signed(type) ? "int" : "UINT") + bits;  // capital letters are allowed
  }

  [[nodiscard]] std::string sharding_json() const {
    const auto encoding = [](bool packed) { return packed ? R"("gzip")" : R"("raw")"; };
    return R"({"@type": "neuroglancer_uint64_sharded_v1", "preshift_bits": )" +
           std::to_string(sharding->preshift) + R"(, "hash": ")" +
           (sharding->hashed ? "murmurhash3_x86_128" : "identity") + R"(", "minishard_bits": )" +
           std::to_string(sharding->minishard) + R"(, "shard_bits": )" +
           std::to_string(sharding->shard) + R"(, "minishard_index_encoding": )" +
           encoding(sharding->packed_index) + R"(, "data_encoding": )" +
           encoding(sharding->packed_data) + "}";
  }

  void write_chunk(std::filesystem::path path, const std::string& bytes) const {
    if (packing == kGzippedWithEnding) path += ".gz";
    write_file(path, packing == kPlain ? bytes : gzip(bytes));
  }

  void write_shards(Random& random, const std::filesystem::path& folder,
                    const std::map<std::uint64_t, std::string>& chunks) const {
    using Minishards = std::map<std::uint64_t, std::map<std::uint64_t, std::string>>;
    std::map<std::uint64_t, Minishards> shards;
    for (const auto& [id, bytes] : chunks) {
      std::uint64_t hash = id >> sharding->preshift;
      if (sharding->hashed) {
        const auto h = murmur_reference(number_bytes(hash, 8, false), 0);
        hash = h[0] | std::uint64_t{h[1]} << 32;
      }
      const std::uint64_t minishard = hash % (std::uint64_t{1} << sharding->minishard);
      const std::uint64_t shard =
          (hash >> sharding->minishard) % (std::uint64_t{1} << sharding->shard);
      shards[shard][minishard][id] = sharding->packed_data ? gzip(bytes) : bytes;
    }
    for (const auto& [shard, minishards] : shards) {
      std::string digits;
      for (int i = (sharding->shard + 3) / 4 - 1; i >= 0; --i) {
        digits += "0123456789abcdef"[shard >> (4 * i) & 15U];
      }
      if (digits.empty()) digits = "0";
      write_file(folder / (digits + ".shard"), shard_bytes(random, minishards));
    }
  }

  /// Index, then for each minishard its chunks with gaps between them, and its own index.
  template <class Minishards>
  [[nodiscard]] std::string shard_bytes(Random& random, const Minishards& minishards) const {
    std::string data = "gap";
    std::vector<std::uint64_t> ranges(2U << sharding->minishard, 0);
    for (const auto& [minishard, chunks] : minishards) {
      std::string ids, starts, sizes;
      std::uint64_t last_id = 0, last_end = 0;
      for (const auto& [id, bytes] : chunks) {
        data += std::string(random() % 3, 'g');
        ids += number_bytes(id - last_id, 8, false);
        starts += number_bytes(data.size() - last_end, 8, false);
        sizes += number_bytes(bytes.size(), 8, false);
        data += bytes;
        last_id = id;
        last_end = data.size();
      }
      const std::string index = ids.append(starts).append(sizes);
      ranges[2 * minishard] = data.size();
      data += sharding->packed_index ? gzip(index) : index;
      ranges[2 * minishard + 1] = data.size();
    }
    std::string bytes;
    for (const std::uint64_t position : ranges) bytes += number_bytes(position, 8, false);
    return bytes + data;
  }
};

}  // namespace mw::io
