// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes Zarr stores by the letter of the two specifications, voxel by voxel.
#pragma once

#include <nlohmann/json.hpp>

#include "io/codec/checksums.h"
#include "tests/io/codec/packers.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {

using Extents = std::vector<std::int64_t>;
using Json = nlohmann::json;

/// Calls visit with every index of an array of any number of axes, the last fastest.
inline void each_of(const Extents& shape, const std::function<void(const Extents&)>& visit) {
  std::int64_t count = 1;
  for (const std::int64_t extent : shape) count *= extent;
  for (std::int64_t number = 0; number < count; ++number) {
    Extents index(shape.size());
    std::int64_t rest = number;
    for (std::size_t axis = shape.size(); axis-- > 0;) {
      index[axis] = rest % shape[axis];
      rest /= shape[axis];
    }
    visit(index);
  }
}

inline std::string packed_by(const std::string& codec, const std::string& plain, int type_size) {
  const auto size = static_cast<std::size_t>(type_size);
  if (codec == "gzip") return gzip(plain);
  if (codec == "zlib") return zlib_packed(plain);
  if (codec == "zstd") return zstd_packed(plain);
  if (codec == "zstd-stream") return zstd_packed(plain, true);
  if (codec == "blosc") return blosc_packed(plain, "lz4", 1, size);
  if (codec == "lz4") return lz4_packed(plain);
  if (codec == "bz2") return bzip2_packed(plain);
  if (codec == "lzma") return xz_packed(plain, 1);
  if (codec == "crc32c") {
    return plain + number_bytes(crc32c(std::as_bytes(std::span(plain))), 4, false);
  }
  return plain;
}

/// An array of (.., z, y, x) of which one part, of the volume's shape, has more than one entry.
struct ZarrSample {
  Index3 shape;                  ///< (x, y, z)
  std::vector<RawLabel> labels;  ///< x fastest
  VoxelType type = VoxelType::kU8;
  bool big = false;
  std::size_t leading = 0;  ///< further axes of one entry in front
  Extents chunk;            ///< of the grid, an entry an axis
  RawLabel fill = 0;
  bool leave_out_fill = true;  ///< chunks of nothing but the fill value are not written
  char separator = '.';
  std::vector<std::string> packing;  ///< codecs, first first
  // Of version 2.
  bool fortran = false;
  // Of version 3.
  std::vector<std::vector<std::size_t>> transposes;
  Extents inner;                             ///< with shards: their chunks; empty: none
  std::vector<std::size_t> shard_transpose;  ///< in front of sharding_indexed; empty: none
  bool index_at_end = true;
  bool index_checksum = true;
  bool v2_keys = false;

  [[nodiscard]] std::size_t axes() const { return leading + 3; }
  [[nodiscard]] Extents array_shape() const {
    Extents out(leading, 1);
    out.insert(out.end(), {shape.z, shape.y, shape.x});
    return out;
  }
  /// What is behind the end of the volume in a chunk is anything.
  [[nodiscard]] std::optional<RawLabel> label(const Extents& index) const {
    for (std::size_t i = 0; i < leading; ++i) {
      if (index[i] > 0) return std::nullopt;
    }
    const Index3 v{index[leading + 2], index[leading + 1], index[leading]};
    const Box3 all{{0, 0, 0}, shape};
    if (!all.contains(v)) return std::nullopt;
    return labels[static_cast<std::size_t>(all.offset(v))];
  }
  [[nodiscard]] bool is_fill(const Extents& first, const Extents& extents) const {
    bool only = true;
    each_of(extents, [&](const Extents& inside) {
      only = only && label(sum(first, inside)).value_or(fill) == fill;
    });
    return only;
  }
  static Extents sum(Extents a, const Extents& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
    return a;
  }
  static Extents product(Extents a, const Extents& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] *= b[i];
    return a;
  }
  static Extents quotient(Extents a, const Extents& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = (a[i] + b[i] - 1) / b[i];
    return a;
  }

  /// Axis i of what comes out is axis order[i] of what goes in.
  static Extents transposed(const Extents& extents, const std::vector<std::size_t>& order) {
    Extents out;
    for (const std::size_t axis : order) out.push_back(extents[axis]);
    return out;
  }

  /// The voxels from `first` on, through the transposes one after the other.
  [[nodiscard]] std::string chunk_bytes(const Extents& first, const Extents& extents) const {
    std::vector<std::vector<std::size_t>> all;
    if (!shard_transpose.empty()) all.push_back(shard_transpose);
    all.insert(all.end(), transposes.begin(), transposes.end());
    if (fortran) {
      all.emplace_back(axes());
      std::iota(all.back().rbegin(), all.back().rend(), std::size_t{0});
    }
    Extents stored = extents;
    for (const auto& order : all) stored = transposed(stored, order);
    std::string bytes;
    each_of(stored, [&](Extents index) {
      for (auto order = all.rbegin(); order != all.rend(); ++order) {
        Extents before(index.size());
        for (std::size_t i = 0; i < index.size(); ++i) before[(*order)[i]] = index[i];
        index = before;
      }
      bytes += number_bytes(label(sum(first, index)).value_or(fill ^ 1U), byte_size(type), big);
    });
    for (const std::string& codec : packing) bytes = packed_by(codec, bytes, byte_size(type));
    return bytes;
  }

  [[nodiscard]] std::string shard_bytes(const Extents& first) const {
    std::string body, index;
    const Extents counts = quotient(chunk, inner);
    const auto order = shard_transpose.empty() ? identity() : shard_transpose;
    const std::size_t index_bytes = [&] {
      std::size_t count = 1;
      for (const std::int64_t n : counts) count *= static_cast<std::size_t>(n);
      return 16 * count + (index_checksum ? 4 : 0);
    }();
    each_of(transposed(counts, order), [&](const Extents& number) {
      Extents inside(number.size());
      for (std::size_t i = 0; i < number.size(); ++i) inside[order[i]] = number[i];
      const Extents at = sum(first, product(inside, inner));
      if (leave_out_fill && is_fill(at, inner)) {
        index += std::string(16, '\xff');
        return;
      }
      const std::string bytes = chunk_bytes(at, inner);
      index += number_bytes(body.size() + (index_at_end ? 0 : index_bytes), 8, false);
      index += number_bytes(bytes.size(), 8, false);
      body += bytes;
    });
    if (index_checksum) index = packed_by("crc32c", index, 1);
    return index_at_end ? body + index : index + body;
  }

  [[nodiscard]] std::vector<std::size_t> identity() const {
    std::vector<std::size_t> order(axes());
    std::iota(order.begin(), order.end(), std::size_t{0});
    return order;
  }

  void write_chunks(const std::filesystem::path& folder, const std::string& prefix) const {
    each_of(quotient(array_shape(), chunk), [&](const Extents& number) {
      const Extents first = product(number, chunk);
      if (leave_out_fill && is_fill(first, chunk)) return;
      std::string key = prefix;
      for (std::size_t i = 0; i < number.size(); ++i) {
        key += (i == 0 ? "" : std::string(1, separator)) + std::to_string(number[i]);
      }
      write_file(folder / key, inner.empty() ? chunk_bytes(first, chunk) : shard_bytes(first));
    });
  }

  [[nodiscard]] Json fill_value() const {
    return is_signed(type) ? Json(static_cast<std::int64_t>(fill)) : Json(fill);
  }

  [[nodiscard]] Json v2_metadata() const {
    const std::string kind = is_float(type) ? "f" : is_signed(type) ? "i" : "u";
    const std::string order = byte_size(type) == 1 ? "|" : big ? ">" : "<";
    Json json{{"zarr_format", 2},
              {"shape", array_shape()},
              {"chunks", chunk},
              {"dtype", order + kind + std::to_string(byte_size(type))},
              {"fill_value", fill_value()},
              {"order", fortran ? "F" : "C"},
              {"filters", nullptr},
              {"compressor", nullptr},
              {"dimension_separator", std::string(1, separator)}};
    if (!packing.empty()) {
      json["compressor"] = {{"id", packing[0] == "zstd-stream" ? "zstd" : packing[0]}};
    }
    return json;
  }
  void write_v2(const std::filesystem::path& folder) const {
    write_file(folder / ".zarray", v2_metadata().dump());
    write_chunks(folder, "");
  }

  [[nodiscard]] Json v3_codecs() const {
    Json codecs = Json::array();
    for (const auto& order : transposes) {
      codecs.push_back({{"name", "transpose"}, {"configuration", {{"order", order}}}});
    }
    codecs.push_back({{"name", "bytes"}, {"configuration", {{"endian", big ? "big" : "little"}}}});
    for (const std::string& codec : packing) {
      codecs.push_back({{"name", codec == "zstd-stream" ? "zstd" : codec}});
      if (codec != "crc32c") codecs.back()["configuration"] = {{"level", 5}};
    }
    return codecs;
  }
  [[nodiscard]] Json v3_metadata() const {
    Json codecs = v3_codecs();
    if (!inner.empty()) {
      Json index = Json::array({{{"name", "bytes"}, {"configuration", {{"endian", "little"}}}}});
      if (index_checksum) index.push_back({{"name", "crc32c"}});
      Json sharding{
          {"name", "sharding_indexed"},
          {"configuration",
           {{"chunk_shape", shard_transpose.empty() ? inner : transposed(inner, shard_transpose)},
            {"codecs", codecs},
            {"index_codecs", index}}}};
      if (!index_at_end) sharding["configuration"]["index_location"] = "start";
      codecs = Json::array();
      if (!shard_transpose.empty()) {
        codecs.push_back({{"name", "transpose"}, {"configuration", {{"order", shard_transpose}}}});
      }
      codecs.push_back(sharding);
    }
    return {{"zarr_format", 3},
            {"node_type", "array"},
            {"shape", array_shape()},
            {"data_type", v3_type()},
            {"chunk_grid", {{"name", "regular"}, {"configuration", {{"chunk_shape", chunk}}}}},
            {"chunk_key_encoding",
             {{"name", v2_keys ? "v2" : "default"},
              {"configuration", {{"separator", std::string(1, separator)}}}}},
            {"fill_value", fill_value()},
            {"codecs", codecs},
            {"attributes", Json::object()}};
  }
  [[nodiscard]] std::string v3_type() const {
    const std::string bits = std::to_string(8 * byte_size(type));
    return (is_float(type) ? "float" : is_signed(type) ? "int" : "uint") + bits;
  }
  void write_v3(const std::filesystem::path& folder) const {
    write_file(folder / "zarr.json", v3_metadata().dump());
    write_chunks(folder, v2_keys ? "" : std::string("c") + separator);
  }
};

/// A random volume, its chunks and fill value, without packing.
inline ZarrSample random_sample(Random& random, std::int64_t max) {
  ZarrSample sample{.shape = pick_shape(random, max)};
  sample.type = kAllTypes[random() % std::size(kAllTypes)];
  sample.labels = random_labels(random, sample.shape, sample.type);
  sample.big = random() % 2 == 0;
  sample.leading = random() % 3;
  for (std::size_t i = 0; i < sample.leading; ++i) sample.chunk.push_back(pick(random, 1, 2));
  for (int i = 0; i < 3; ++i) sample.chunk.push_back(pick(random, 1, 9));
  sample.fill = sample.labels[random() % sample.labels.size()];
  sample.leave_out_fill = random() % 4 != 0;
  sample.separator = random() % 2 == 0 ? '.' : '/';
  // A corner of nothing but the fill value, so that chunks are missing.
  const Box3 all{{0, 0, 0}, sample.shape};
  const Index3 cut = pick_shape(random, max);
  for (Index3 v{0, 0, 0}; v.z < sample.shape.z; ++v.z) {
    for (v.y = 0; v.y < sample.shape.y; ++v.y) {
      for (v.x = 0; v.x < sample.shape.x; ++v.x) {
        if (v.x < cut.x && v.y < cut.y && v.z < cut.z) {
          sample.labels[static_cast<std::size_t>(all.offset(v))] = sample.fill;
        }
      }
    }
  }
  return sample;
}

inline std::vector<std::size_t> random_order(Random& random, std::size_t axes) {
  std::vector<std::size_t> order(axes);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), random);
  return order;
}

/// Shards of some chunks along each axis.
inline void make_shards(Random& random, ZarrSample& sample) {
  sample.inner = sample.chunk;
  for (std::int64_t& extent : sample.chunk) extent *= pick(random, 1, 3);
  sample.index_at_end = random() % 2 == 0;
  sample.index_checksum = random() % 4 != 0;
  if (random() % 3 == 0) sample.shard_transpose = random_order(random, sample.axes());
}

}  // namespace mw::io
