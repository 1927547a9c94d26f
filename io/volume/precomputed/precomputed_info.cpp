// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and checks a scale of `info` (neuroglancer's "precomputed" format, volumes).
#include "io/volume/precomputed/open_precomputed.h"

#include <algorithm>
#include <cstdlib>

#include "io/chunks/chunk.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/json/json_fields.h"
#include "io/volume/checks.h"

namespace mw::io {
namespace {

/// The largest offset: far beyond any volume, and still exact in a double.
constexpr std::int64_t kMaxOffset = std::int64_t{1} << 48;
/// The largest index of a minishard that is kept in memory.
constexpr std::uint64_t kMaxIndexBytes = 256ULL << 20U;

std::string keys_of(const JsonFields& info) {
  constexpr std::size_t kMax = 20;
  const std::size_t count = info.count("scales");
  std::string out;
  for (std::size_t i = 0; i < std::min(count, kMax); ++i) {
    out += (i == 0 ? "" : ", ") + info.element("scales", i).text("key");
  }
  return count > kMax ? out + ", ..." : out;
}

JsonFields scale_of_key(const JsonFields& info, const std::string& key) {
  for (std::size_t i = 0; i < info.count("scales"); ++i) {
    JsonFields scale = info.element("scales", i);
    if (scale.text("key") == key) return scale;
  }
  fail_usage("--dataset ", key, ": ", info.file(), " has no scale of this key; it has ",
             keys_of(info));
}

JsonFields wanted_scale(const JsonFields& info, const OpenOptions& options) {
  const std::size_t count = info.count("scales");
  if (count == 0) info.fail("scales", "there is none", "get a whole copy of the file");
  if (!options.dataset.empty()) {
    if (!options.scale) return scale_of_key(info, options.dataset);
    fail_usage("--dataset and --scale both choose a scale of a precomputed volume: give one");
  }
  const int number = options.scale.value_or(0);
  if (number >= 0 && static_cast<std::size_t>(number) < count) {
    return info.element("scales", static_cast<std::size_t>(number));
  }
  fail_usage("--scale ", number, ": ", info.file(), " has ", count, " scales, 0 (the finest) to ",
             count - 1, ": ", keys_of(info));
}

VoxelType type_of(const JsonFields& info) {
  if (info.has("num_channels") && info.integer("num_channels") != 1) {
    info.fail("num_channels",
              text(info.integer("num_channels"), " channels, and labels are one number a voxel"),
              "write one channel to a volume of its own");
  }
  return store_type(info, "data_type");
}

Index3 offset_of(const JsonFields& fields) {
  if (!fields.has("voxel_offset")) return {0, 0, 0};
  const auto offset = fields.integers3("voxel_offset");
  for (const std::int64_t x : offset) {
    if (x > -kMaxOffset && x < kMaxOffset) continue;
    fields.fail("voxel_offset", text("offset ", x, " is beyond 2^48"), "the file is damaged");
  }
  return {offset[0], offset[1], offset[2]};
}

Index3 chunk_of(const JsonFields& fields, Index3 shape, VoxelType type) {
  const auto size = fields.first_integers3("chunk_sizes");
  for (const std::int64_t extent : size) {
    if (extent < 1) {
      fields.fail("chunk_sizes", text("extent ", extent, " of a chunk is not positive"),
                  "the file is damaged");
    }
  }
  const Index3 chunk{std::min(size[0], shape.x), std::min(size[1], shape.y),
                     std::min(size[2], shape.z)};
  static_cast<void>(checked_chunk_bytes(fields.file(), fields.name_of("chunk_sizes"), chunk, type));
  return chunk;
}

void check_block(const JsonFields& fields, const SegmentationLayout& layout) {
  constexpr std::string_view kField = "compressed_segmentation_block_size";
  std::int64_t voxels = 1;
  for (const std::int64_t extent : {layout.block.x, layout.block.y, layout.block.z}) {
    if (extent < 1 || extent > kMaxBlockVoxels / voxels) {
      fields.fail(kField,
                  text("blocks of ", layout.block.x, " x ", layout.block.y, " x ", layout.block.z,
                       " voxels are not 1 to ", kMaxBlockVoxels),
                  "the file is damaged");
    }
    voxels *= extent;
  }
  if (max_segmentation_bytes(layout) <= 2 * kMaxChunkBytes) return;
  fields.fail(kField,
              "the blocks are so much larger than the chunks that these may need over 4 GiB",
              "write the volume with blocks of 8 x 8 x 8");
}

/// Returns the size of a block; nothing for raw chunks.
std::optional<Index3> block_of(const JsonFields& fields, Index3 chunk, VoxelType type) {
  const std::string encoding = lower_case(fields.text("encoding"));
  if (encoding == "raw") return std::nullopt;
  if (encoding != "compressed_segmentation") {
    fields.fail("encoding", text("chunks in '", encoding, "' are not read here"),
                "supported are raw and compressed_segmentation: copy the volume to one of them");
  }
  if (type != VoxelType::kU32 && type != VoxelType::kU64) {
    fields.fail("encoding",
                text("compressed_segmentation holds uint32 or uint64, not ", mw::io::name(type)),
                "the file is damaged");
  }
  const auto size = fields.integers3("compressed_segmentation_block_size");
  const Index3 block{size[0], size[1], size[2]};
  check_block(fields, {.shape = chunk, .block = block, .type = type});
  return block;
}

int bits_of(const JsonFields& fields, std::string_view key, int max) {
  const std::int64_t bits = fields.integer(key);
  if (bits >= 0 && bits <= max) return static_cast<int>(bits);
  fields.fail(key, text(bits, " bits are not 0 to ", max), "the file is damaged");
}

bool is_gzipped(const JsonFields& fields, std::string_view key) {
  if (!fields.has(key)) return false;
  const std::string encoding = fields.text(key);
  if (encoding == "gzip") return true;
  if (encoding == "raw") return false;
  fields.fail(key, text("encoding '", encoding, "' is not read here"),
              "supported are raw and gzip");
}

bool is_hashed(const JsonFields& fields) {
  const std::string hash = fields.text("hash");
  if (hash == "murmurhash3_x86_128") return true;
  if (hash == "identity") return false;
  fields.fail("hash", text("hash '", hash, "' is not known here"),
              "supported are identity and murmurhash3_x86_128");
}

std::optional<Sharding> sharding_of(const JsonFields& scale, Index3 grid) {
  constexpr std::string_view kType = "neuroglancer_uint64_sharded_v1";
  if (!scale.has("sharding")) return std::nullopt;
  const JsonFields fields = scale.object("sharding");
  if (fields.text("@type") != kType) {
    fields.fail("@type", text("shards of type '", fields.text("@type"), "' are not read here"),
                text("supported is ", kType));
  }
  Sharding out{.hashed = is_hashed(fields),
               .preshift_bits = bits_of(fields, "preshift_bits", 64),
               .minishard_bits = bits_of(fields, "minishard_bits", 32),
               .packed_index = is_gzipped(fields, "minishard_index_encoding"),
               .packed_data = is_gzipped(fields, "data_encoding")};
  out.shard_bits = bits_of(fields, "shard_bits", 64 - out.minishard_bits);
  const std::uint64_t max = max_in_minishard(out, grid);
  if (max * sizeof(ShardEntry) > kMaxIndexBytes) {
    fields.fail("minishard_bits",
                text("one minishard may list ", max, " chunks, and at most ",
                     kMaxIndexBytes / sizeof(ShardEntry), " are read"),
                "write the volume with more minishards");
  }
  return out;
}

/// Offsets count voxels, so that a spacing that replaces the file's moves the origin, too.
VolumeSpace space_of(const JsonFields& fields, Index3 offset, const OpenOptions& options) {
  const std::string field = fields.name_of("resolution");
  Vector3 spacing = options.spacing.value_or(Vector3{});
  if (!options.spacing) {
    spacing = fields.numbers3("resolution");
    for (const double x : spacing) check_spacing(fields.file(), field, x);
  }
  const FileSpace space{.steps = steps_of(spacing),
                        .first = Vector3{static_cast<double>(offset.x) * spacing[0],
                                         static_cast<double>(offset.y) * spacing[1],
                                         static_cast<double>(offset.z) * spacing[2]},
                        .first_is_centre = false,
                        .unit = "nm",
                        .steps_field = field.c_str(),
                        .first_field = "voxel_offset"};
  return placed(fields.file(), space, options);
}

}  // namespace

PrecomputedScale parse_precomputed_info(const Json& json, std::string_view file,
                                        const OpenOptions& options) {
  const JsonFields info(json, std::string(file));
  if (info.has("@type") && info.text("@type") != "neuroglancer_multiscale_volume") {
    info.fail("@type", text("'", info.text("@type"), "' is no volume"),
              "give the folder of the volume");
  }
  const JsonFields fields = wanted_scale(info, options);
  PrecomputedScale out{.key = fields.text("key"), .key_field = fields.name_of("key")};
  out.type = type_of(info);
  out.shape = checked_shape(file, fields.name_of("size"), fields.integers3("size"));
  out.offset = offset_of(fields);
  out.chunk = chunk_of(fields, out.shape, out.type);
  out.space = space_of(fields, out.offset, options);
  out.block = block_of(fields, out.chunk, out.type);
  out.sharding = sharding_of(fields, chunk_grid(out));
  return out;
}

Index3 chunk_grid(const PrecomputedScale& scale) {
  return cells_of({{0, 0, 0}, scale.shape}, scale.chunk).hi;
}

}  // namespace mw::io
