// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The chunks of a scale of a precomputed volume, from files or shards, and the volume.
#include "io/volume/precomputed/open_precomputed.h"

#include <algorithm>

#include "io/chunks/chunked_volume.h"
#include "io/codec/codec.h"
#include "io/file/errors.h"
#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/json/json.h"
#include "io/json/json_fields.h"

namespace mw::io {
namespace {

constexpr std::string_view kWayOut = "get a whole copy of the store";

/// Refuses a chunk that is there in another packing, as it must not be taken for background.
void refuse_packed_otherwise(const Place& path) {
  for (const char* ending : {".br", ".zst", ".bz2", ".xz"}) {
    const Place other = path + ending;
    if (!other.is_file()) continue;
    fail_input(other.string(), {}, "chunks in this packing are not read here",
               "copy the volume with gzip or without packing");
  }
}

Place folder_of(const Place& volume, const PrecomputedScale& scale, bool is_trusted) {
  const std::string info = (volume / "info").string();
  static_cast<void>(named_path(info, scale.key_field, scale.key, is_trusted));  // checks the name
  Place folder = volume / scale.key;
  if (!folder.is_folder().value_or(true)) {
    fail_input(info, scale.key_field,
               text("the folder of the chunks, ", folder.string(), ", is missing"),
               "get a whole copy of the store, or choose a scale that is there with --scale");
  }
  return folder;
}

}  // namespace

PrecomputedChunks::PrecomputedChunks(Place folder, PrecomputedScale scale)
    : folder_(std::move(folder)), scale_(std::move(scale)), grid_(chunk_grid(scale_)) {
  if (scale_.sharding) shards_.emplace(folder_, *scale_.sharding, grid_);
}

/// Returns the file "x0-x1_y0-y1_z0-z1" of a chunk, in voxels from the origin of the world.
Place PrecomputedChunks::path_of(Index3 chunk) const {
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

/// Returns the most bytes of a chunk before its encoding is undone; raw ones have just as many.
std::uint64_t PrecomputedChunks::max_encoded(Index3 shape) const {
  if (scale_.block) return max_segmentation_bytes(layout_of(shape));
  return static_cast<std::uint64_t>(shape.product()) *
         static_cast<std::uint64_t>(byte_size(scale_.type));
}

/// Servers give gzipped files under the chunk's name, tools write them with .gz behind it.
PrecomputedChunks::Stored PrecomputedChunks::find_file(Index3 chunk, std::uint64_t wanted) const {
  const Place path = path_of(chunk);
  if (std::shared_ptr<const ByteSource> file = path.open_if_there(max_packed_bytes(wanted))) {
    const bool gzip = is_gzip(*file);
    const bool right_size = !scale_.block && file->size() == wanted;
    return {.bytes = std::move(file), .is_gzip = gzip, .may_be_raw = right_size};
  }
  const Place packed = path + ".gz";
  if (std::shared_ptr<const ByteSource> file = packed.open_if_there(max_packed_bytes(wanted))) {
    return {.bytes = std::move(file), .is_gzip = true};
  }
  if (path.is_near()) refuse_packed_otherwise(path);
  return {};
}

PrecomputedChunks::Stored PrecomputedChunks::find_shard(Index3 chunk, std::uint64_t wanted) const {
  const bool packed = scale_.sharding->packed_data;
  return {.bytes = shards_->find(morton_code(chunk, grid_), name_of(chunk),
                                 packed ? max_packed_bytes(wanted) : wanted),
          .is_gzip = packed};
}

/// Returns a chunk without its packing.
Chunk PrecomputedChunks::read(const Stored& stored, std::uint64_t wanted, ChunkPlace place) const {
  if (stored.is_gzip && stored.may_be_raw) {
    // Raw voxels of the right size may begin like gzip, whose checksum tells.
    try {
      return read({.bytes = stored.bytes, .is_gzip = true}, wanted, place);
    } catch (const Error&) {
      return read({.bytes = stored.bytes}, wanted, place);
    }
  }
  const Codec codec = stored.is_gzip ? Codec::kGzip : Codec::kNone;
  Chunk out{.bytes = {}, .strides = {}};
  if (place == ChunkPlace::kFile) {
    out.file = unpack_to_file(codec, stored.bytes, wanted);
  } else {
    out.bytes = read_rest(*stored.bytes, 0, max_packed_bytes(wanted));
    if (stored.is_gzip) out.bytes = unpack(codec, out.bytes, wanted, stored.bytes->name());
  }
  return out;
}

std::optional<Chunk> PrecomputedChunks::load(Index3 chunk, const Box3& box,
                                             ChunkPlace place) const {
  const Index3 shape = box.shape();
  const std::uint64_t wanted = max_encoded(shape);
  const Stored stored = shards_ ? find_shard(chunk, wanted) : find_file(chunk, wanted);
  if (!stored.bytes) return std::nullopt;
  Chunk out = read(stored, wanted, streaming_bytes() ? place : ChunkPlace::kMemory);
  if (scale_.block) {
    out.bytes = unpack_segmentation(out.bytes, layout_of(shape), name_of(chunk));
  } else if (out.size() != wanted) {
    fail_input(name_of(chunk), {},
               text(out.size(), " bytes, and its ", shape.x, " x ", shape.y, " x ", shape.z,
                    " voxels of ", mw::io::name(scale_.type), " are ", wanted),
               kWayOut);
  }
  out.strides = {1, shape.x, shape.x * shape.y};
  return out;
}

std::optional<std::uint64_t> PrecomputedChunks::streaming_bytes() const {
  if (scale_.block) return std::nullopt;
  const std::uint64_t held = folder_.held_bytes(max_packed_bytes(max_encoded(scale_.chunk)));
  return *max_streamed(Codec::kGzip) + (shards_ ? shards_->scratch_bytes() : held);
}

std::uint64_t PrecomputedChunks::scratch_bytes() const {
  const std::uint64_t encoded = max_encoded(scale_.chunk);
  const std::uint64_t packed = max_packed_bytes(encoded);
  const std::uint64_t unpacking = packed + max_scratch(Codec::kGzip, encoded);
  return unpacking + (scale_.block ? encoded : 0) +
         (shards_ ? shards_->scratch_bytes() : folder_.held_bytes(packed));
}

bool is_precomputed(const Place& folder) {
  return (folder / "info").is_document();
}

std::unique_ptr<LabelVolume> open_precomputed(const Place& folder, const OpenOptions& options) {
  const Place path = folder / "info";
  PrecomputedScale scale = parse_precomputed_info(read_json(path), path.string(), options);
  VolumeInfo info{.shape = scale.shape,
                  .space = scale.space,
                  .type = scale.type,
                  .format = "precomputed",
                  .chunk = scale.chunk,
                  .offset = scale.offset,
                  .is_far = !folder.is_near()};
  const VoxelCoding coding{.type = scale.type, .order = ByteOrder::kLittle};
  auto chunks = std::make_unique<PrecomputedChunks>(folder_of(folder, scale, options.trust_paths),
                                                    std::move(scale));
  return std::make_unique<ChunkedVolume>(std::move(info), coding, ChunkFill{}, std::move(chunks),
                                         options.cache_bytes);
}

std::size_t count_precomputed_scales(const Place& folder, const OpenOptions& /*options*/) {
  const Place path = folder / "info";
  const Json info = read_json(path);
  return JsonFields(info, path.string()).count("scales");
}

}  // namespace mw::io
