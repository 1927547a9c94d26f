// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A writer of N5 arrays, after the format's description and by no code of the reader.
#pragma once

#include "io/codec/checksums.h"
#include "tests/io/codec/packers.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {

/// A stream of lz4-java: blocks with magic, sizes and checksum; an empty one at the end.
inline std::string lz4_java_packed(const std::string& plain) {
  std::string packed;
  for (std::size_t at = 0; at <= plain.size(); at += 500) {
    const std::string part = plain.substr(at, 500);
    const std::string body = part.empty() ? part : lz4_block(part);
    const std::uint32_t sum = xxhash32(std::as_bytes(std::span(part)), 0x9747b28c) & 0xfffffffU;
    packed += "LZ4Block" + std::string(1, part.empty() ? '\x16' : '\x26') +
              number_bytes(body.size(), 4, false) + number_bytes(part.size(), 4, false) +
              number_bytes(part.empty() ? 0 : sum, 4, false) + body;
    if (part.empty()) return packed;
  }
  return packed + "LZ4Block\x16" + std::string(12, '\0');
}

/// A compression as attributes.json has it, and what does it.
struct N5Packing {
  std::string json;
  std::string (*pack)(const std::string& plain);
};

inline const std::vector<N5Packing> kN5Packings{
    {R"({"type": "raw"})", [](const std::string& plain) { return plain; }},
    {R"({"type": "gzip", "level": -1})", gzip},
    {R"({"type": "gzip", "useZlib": true})", zlib_packed},
    {R"({"type": "bzip2", "blockSize": 9})", bzip2_packed},
    {R"({"type": "xz", "preset": 0})",
     [](const std::string& plain) { return xz_packed(plain, 0); }},
    {R"({"type": "lz4", "blockSize": 500})", lz4_java_packed},
    {R"({"type": "lz4", "id": "lz4"})", lz4_packed},
    {R"({"type": "zstd", "level": 3})",
     [](const std::string& plain) { return zstd_packed(plain); }},
    {R"({"type": "blosc", "cname": "zstd"})",
     [](const std::string& plain) { return blosc_packed(plain, "zstd", 1, 2); }},
};

struct N5Sample {
  Index3 shape{7, 6, 5};
  Index3 block{4, 4, 4};
  VoxelType type = VoxelType::kU32;
  N5Packing packing = kN5Packings[0];
  /// Extents of axes that are left out, put in behind the first `before` axes of the volume.
  std::vector<std::int64_t> others{};  ///< blocks are so long there; the array is 1
  std::size_t before = 3;
  bool whole_blocks = false;  ///< blocks at the end are as large as the others
  bool counted = false;       ///< mode 1
  std::string extra{};        ///< further attributes, each with a comma in front

  /// x, y and z with the other axes between them.
  [[nodiscard]] std::vector<std::int64_t> with_others(Index3 v,
                                                      std::vector<std::int64_t> rest) const {
    std::vector<std::int64_t> all{v.x, v.y, v.z};
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(before), rest.begin(), rest.end());
    return all;
  }

  [[nodiscard]] static std::string list(const std::vector<std::int64_t>& numbers) {
    std::string out = "[";
    for (const std::int64_t number : numbers) {
      out += (out.size() > 1 ? ", " : "") + std::to_string(number);
    }
    return out + "]";
  }

  [[nodiscard]] std::string attributes() const {
    const std::vector<std::int64_t> ones(others.size(), 1);
    const std::string bits = std::to_string(8 * byte_size(type));
    const std::string kind = is_float(type) ? "float" : is_signed(type) ? "int" : "uint";
    return R"({"dimensions": )" + list(with_others(shape, ones)) + R"(, "blockSize": )" +
           list(with_others(block, others)) + R"(, "dataType": ")" + kind + bits +
           R"(", "compression": )" + packing.json + extra + "}";
  }

  /// Blocks whose labels are all 0 are not written.
  void write(Random& random, const std::filesystem::path& folder,
             const std::vector<RawLabel>& labels) const {
    write_file(folder / "attributes.json", attributes());
    each_chunk(shape, block, [&](Index3 number, const Box3& box) {
      const std::vector<RawLabel> inside = part_of(labels, shape, box);
      if (std::all_of(inside.begin(), inside.end(), [](RawLabel l) { return l == 0; })) return;
      std::filesystem::path path = folder;
      for (const std::int64_t n : with_others(number, std::vector<std::int64_t>(others.size()))) {
        path /= std::to_string(n);
      }
      write_file(path, block_bytes(random, inside, box.shape()));
    });
  }

 private:
  [[nodiscard]] std::string block_bytes(Random& random, const std::vector<RawLabel>& inside,
                                        Index3 held) const {
    const Index3 extent = whole_blocks ? block : held;
    const auto extents = with_others(extent, others);
    std::string plain;
    std::int64_t values = 1;
    for (const std::int64_t n : extents) values *= n;
    // Each value's place along every axis tells whether it is a voxel or filling.
    for (std::int64_t i = 0; i < values; ++i) {
      std::vector<std::int64_t> index;
      for (std::int64_t rest = i; const std::int64_t n : extents) {
        index.push_back(rest % n);
        rest /= n;
      }
      plain += number_bytes(value_at(random, inside, held, index), byte_size(type), true);
    }
    std::string head =
        number_bytes(counted ? 1 : 0, 2, true) + number_bytes(extents.size(), 2, true);
    for (const std::int64_t n : extents) {
      head += number_bytes(static_cast<std::uint64_t>(n), 4, true);
    }
    if (counted) head += number_bytes(static_cast<std::uint64_t>(values), 4, true);
    return head + packing.pack(plain);
  }

  [[nodiscard]] RawLabel value_at(Random& random, const std::vector<RawLabel>& inside, Index3 held,
                                  std::vector<std::int64_t> index) const {
    bool is_voxel = true;
    for (std::size_t i = 0; i < others.size(); ++i) {
      is_voxel = is_voxel && index[before] == 0;
      index.erase(index.begin() + static_cast<std::ptrdiff_t>(before));
    }
    const Index3 v{index[0], index[1], index[2]};
    const Box3 box{{0, 0, 0}, held};
    if (!is_voxel || !box.contains(v)) return random() % 250;
    return inside[static_cast<std::size_t>(box.offset(v))];
  }
};

}  // namespace mw::io
