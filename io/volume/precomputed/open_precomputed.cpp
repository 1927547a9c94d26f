// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The chunks of a scale of a precomputed volume, from files or shards, and the volume.
#include "io/volume/precomputed/open_precomputed.h"

#include <algorithm>
#include <array>

#include "io/chunks/chunked_volume.h"
#include "io/codec/codec.h"
#include "io/file/errors.h"
#include "io/json/json.h"

namespace mw::io {
namespace {

constexpr std::string_view kWayOut = "get a whole copy of the store";

bool begins_as_gzip(const std::vector<std::byte>& bytes) {
  constexpr std::array kMagic{std::byte{0x1f}, std::byte{0x8b}, std::byte{8}};
  return bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

/// A chunk that is there in another packing must not be taken for background.
void refuse_packed_otherwise(const std::filesystem::path& path) {
  for (const char* ending : {".br", ".zst", ".bz2", ".xz"}) {
    const std::string other = path.string() + ending;
    std::error_code ignored;
    if (!std::filesystem::exists(other, ignored)) continue;
    fail_input(other, {}, "chunks in this packing are not read here",
               "copy the volume with gzip or without packing");
  }
}

}  // namespace

PrecomputedChunks::PrecomputedChunks(std::filesystem::path folder, PrecomputedScale scale)
    : folder_(std::move(folder)), scale_(std::move(scale)), grid_(chunk_grid(scale_)) {
  if (scale_.sharding) shards_.emplace(folder_, *scale_.sharding, grid_);
}

/// "x0-x1_y0-y1_z0-z1", voxels of the world.
std::filesystem::path PrecomputedChunks::path_of(Index3 chunk) const {
  const Index3 size = scale_.chunk, first = scale_.offset, end = first + scale_.shape;
  const Index3 lo = first + Index3{chunk.x * size.x, chunk.y * size.y, chunk.z * size.z};
  const Index3 hi{std::min(lo.x + size.x, end.x), std::min(lo.y + size.y, end.y),
                  std::min(lo.z + size.z, end.z)};
  return folder_ / text(lo.x, "-", hi.x, "_", lo.y, "-", hi.y, "_", lo.z, "-", hi.z);
}

std::string PrecomputedChunks::name_of(Index3 chunk) const {
  if (!shards_) return path_of(chunk).string();
  const std::uint64_t number = morton_code(chunk, grid_);
  return text(shards_->path_of(number).string(), ": chunk ", number, " at (", chunk.x, ", ",
              chunk.y, ", ", chunk.z, ")");
}

SegmentationLayout PrecomputedChunks::layout_of(Index3 shape) const {
  return {.shape = shape, .block = *scale_.block, .type = scale_.type};
}

/// The most bytes of a chunk before its encoding is undone; raw ones have just as many.
std::uint64_t PrecomputedChunks::max_encoded(Index3 shape) const {
  if (scale_.block) return max_segmentation_bytes(layout_of(shape));
  return static_cast<std::uint64_t>(shape.product()) *
         static_cast<std::uint64_t>(byte_size(scale_.type));
}

PrecomputedChunks::Bytes PrecomputedChunks::inflated(Bytes packed, Index3 chunk,
                                                     Index3 shape) const {
  return unpack(Codec::kGzip, packed, max_encoded(shape), name_of(chunk));
}

/// Servers give gzipped files under the chunk's name, tools write them with .gz behind it.
std::optional<PrecomputedChunks::Bytes> PrecomputedChunks::read_file(Index3 chunk,
                                                                     Index3 shape) const {
  const std::filesystem::path path = path_of(chunk);
  const std::uint64_t wanted = max_encoded(shape);
  if (const auto file = open_if_there(path)) {
    Bytes bytes = read_rest(*file, 0, max_packed_bytes(wanted));
    if (!begins_as_gzip(bytes)) return bytes;
    if (scale_.block || bytes.size() != wanted) return inflated(std::move(bytes), chunk, shape);
    // Raw voxels of the right size may begin like gzip: its checksum tells.
    try {
      return inflated(bytes, chunk, shape);
    } catch (const Error&) {
      return bytes;
    }
  }
  if (const auto file = open_if_there(path.string() + ".gz")) {
    return inflated(read_rest(*file, 0, max_packed_bytes(wanted)), chunk, shape);
  }
  refuse_packed_otherwise(path);
  return std::nullopt;
}

std::optional<PrecomputedChunks::Bytes> PrecomputedChunks::read_shard(Index3 chunk,
                                                                      Index3 shape) const {
  const std::uint64_t wanted = max_encoded(shape);
  const bool packed = scale_.sharding->packed_data;
  auto bytes = shards_->read(morton_code(chunk, grid_), packed ? max_packed_bytes(wanted) : wanted);
  if (bytes && packed) return inflated(std::move(*bytes), chunk, shape);
  return bytes;
}

std::optional<Chunk> PrecomputedChunks::load(Index3 chunk, const Box3& box) const {
  const Index3 shape = box.shape();
  std::optional<Bytes> bytes = shards_ ? read_shard(chunk, shape) : read_file(chunk, shape);
  if (!bytes) return std::nullopt;
  if (scale_.block) {
    bytes = unpack_segmentation(*bytes, layout_of(shape), name_of(chunk));
  } else if (bytes->size() != max_encoded(shape)) {
    fail_input(name_of(chunk), {},
               text(bytes->size(), " bytes, and its ", shape.x, " x ", shape.y, " x ", shape.z,
                    " voxels of ", mw::io::name(scale_.type), " are ", max_encoded(shape)),
               kWayOut);
  }
  return Chunk{.bytes = std::move(*bytes), .strides = {1, shape.x, shape.x * shape.y}};
}

std::uint64_t PrecomputedChunks::scratch_bytes() const {
  const std::uint64_t encoded = max_encoded(scale_.chunk);
  const std::uint64_t unpacking = max_packed_bytes(encoded) + max_scratch(Codec::kGzip, encoded);
  return unpacking + (scale_.block ? encoded : 0) + (shards_ ? shards_->scratch_bytes() : 0);
}

namespace {

/// Keys may lead to folders beside that of `info` ("../8_8_8"), by the format's rules, but no
/// further.
bool stays_in_store(const std::filesystem::path& key) {
  if (key.is_absolute() || key.native().find('\0') != std::string::npos) return false;
  int depth = 0;
  for (const std::filesystem::path& part : key) {
    if (part == "..") --depth;
    if (part != ".." && part != "." && !part.empty()) ++depth;
    if (depth < -1) return false;
  }
  return true;
}

std::filesystem::path folder_of(const std::filesystem::path& root, const PrecomputedScale& scale) {
  const std::string info = (root / "info").string();
  if (!stays_in_store(scale.key)) {
    fail_input(info, scale.key_field, "the key leads out of the store",
               "the file is damaged or not sound");
  }
  std::filesystem::path folder = root / scale.key;
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    fail_input(info, scale.key_field,
               text("the folder of the chunks, ", folder.string(), ", is missing"),
               "get a whole copy of the store, or choose a scale that is there with --scale");
  }
  return folder;
}

}  // namespace

bool is_precomputed(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / "info", ignored);
}

std::unique_ptr<LabelVolume> open_precomputed(const std::filesystem::path& folder,
                                              const OpenOptions& options) {
  const std::filesystem::path path = folder / "info";
  PrecomputedScale scale = parse_precomputed_info(read_json(path), path.string(), options);
  VolumeInfo info{.shape = scale.shape,
                  .space = scale.space,
                  .type = scale.type,
                  .format = "precomputed",
                  .chunk = scale.chunk};
  const VoxelCoding coding{.type = scale.type, .order = ByteOrder::kLittle};
  auto chunks = std::make_unique<PrecomputedChunks>(folder_of(folder, scale), std::move(scale));
  return std::make_unique<ChunkedVolume>(std::move(info), coding, 0, std::move(chunks),
                                         options.cache_bytes);
}

}  // namespace mw::io
