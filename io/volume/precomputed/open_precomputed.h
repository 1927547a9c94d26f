// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One scale of a precomputed volume, from its `info` file, and its encoding
// compressed_segmentation.
// Format: https://github.com/google/neuroglancer/blob/master/src/datasource/precomputed/volume.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/chunks/chunk.h"
#include "io/json/json.h"
#include "io/store/place.h"
#include "io/volume/label_volume.h"
#include "io/volume/open_options.h"
#include "io/volume/precomputed/sharding.h"

namespace mw::io {

/// What a chunk does not say about itself.
struct SegmentationLayout {
  Index3 shape;                      ///< extents of the chunk
  Index3 block;                      ///< extents of what is encoded as one
  VoxelType type = VoxelType::kU64;  ///< kU32 or kU64
};

/// The most voxels of a block, as an offset of 24 bits finds its table.
inline constexpr std::int64_t kMaxBlockVoxels = 1 << 24;

/// Returns the most bytes that a chunk needs: all blocks in 32 bits a voxel, each with a table of
/// its own.  REQUIRES: the product of the block is at most kMaxBlockVoxels.
[[nodiscard]] std::uint64_t max_segmentation_bytes(const SegmentationLayout& layout);

/// Returns the voxels of a chunk of one channel, x fastest, least significant byte first.  Errors
/// call the chunk `name`.
/// Memory: what the shape needs.
/// ERRORS: mw::Error(kInput) naming the block where offsets or numbers of bits make no sense, or
/// lead out of the bytes.
[[nodiscard]] std::vector<std::byte> unpack_segmentation(std::span<const std::byte> packed,
                                                         const SegmentationLayout& layout,
                                                         std::string_view name);

/// A scale of `info`.  Sizes are in voxels.
struct PrecomputedScale {
  std::string key;        ///< folder of the chunks, relative to that of `info`
  std::string key_field;  ///< what errors call it: "scales[0].key"
  VoxelType type = VoxelType::kU8;
  Index3 shape;
  Index3 offset;  ///< that of the first voxel in the names of chunks
  Index3 chunk;   ///< not beyond the shape
  VolumeSpace space;
  std::optional<Index3> block;       ///< for compressed_segmentation; empty: raw
  std::optional<Sharding> sharding;  ///< empty: a file for each chunk
};

/// Returns the scale that the options ask for by its key (dataset) or its number (scale), else the
/// first.  Checks all numbers, and bounds what chunks may take.
/// ERRORS: mw::Error(kInput) naming file and field; kUsage when there is no such scale.
[[nodiscard]] PrecomputedScale parse_precomputed_info(const Json& info, std::string_view file,
                                                      const OpenOptions& options);

/// Returns the number of chunks along each axis.
[[nodiscard]] Index3 chunk_grid(const PrecomputedScale& scale);

class PrecomputedChunks : public ChunkSource {
 public:
  /// folder is the one that holds the chunks of the scale.
  PrecomputedChunks(Place folder, PrecomputedScale scale);

  [[nodiscard]] std::string name() const override { return folder_.string(); }
  [[nodiscard]] std::string name_of(Index3 chunk) const override;
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& box,
                                          ChunkPlace place) const override;
  [[nodiscard]] std::uint64_t scratch_bytes() const override;
  [[nodiscard]] std::optional<std::uint64_t> streaming_bytes() const override;

 private:
  using Bytes = std::vector<std::byte>;
  /// A chunk as the store has it.
  struct Stored {
    std::shared_ptr<const ByteSource> bytes;
    bool is_gzip = false;
    bool may_be_raw = false;  ///< though it begins like gzip
  };

  [[nodiscard]] Place path_of(Index3 chunk) const;
  [[nodiscard]] SegmentationLayout layout_of(Index3 shape) const;
  [[nodiscard]] std::uint64_t max_encoded(Index3 shape) const;
  [[nodiscard]] Stored find_file(Index3 chunk, std::uint64_t wanted) const;
  [[nodiscard]] Stored find_shard(Index3 chunk, std::uint64_t wanted) const;
  [[nodiscard]] Chunk read(const Stored& stored, std::uint64_t wanted, ChunkPlace place) const;

  Place folder_;
  PrecomputedScale scale_;
  Index3 grid_;
  std::optional<ShardFolder> shards_;
};

/// Whether the folder has an `info` file.
[[nodiscard]] bool is_precomputed(const Place& folder);

/// Opens a volume whose chunks are raw or in compressed_segmentation, in files of their own or in
/// shards, each also gzipped; what is not there has label 0.  Coordinates are in nm.  options.scale
/// or options.dataset (a key) chooses among the scales.
/// ERRORS: mw::Error(kInput) naming file and field; kUsage when there is no such scale.
[[nodiscard]] std::unique_ptr<LabelVolume> open_precomputed(const Place& folder,
                                                            const OpenOptions& options);

/// Returns how many scales the volume has.  ERRORS: those of open_precomputed().
[[nodiscard]] std::size_t count_precomputed_scales(const Place& folder, const OpenOptions& options);

}  // namespace mw::io
