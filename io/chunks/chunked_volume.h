// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume in chunks, read by region: what all chunked stores end in.
#pragma once

#include <memory>

#include "io/chunks/chunk.h"
#include "io/chunks/chunk_cache.h"
#include "io/volume/label_volume.h"

namespace mw::io {

class ChunkedVolume : public LabelVolume {
 public:
  /// REQUIRES: info.chunk positive on every axis; chunk c holds the voxels from c * info.chunk on.
  /// fill: the label of voxels whose chunk the store does not have.
  /// cache_bytes: of unpacked chunks that are kept between reads.
  ChunkedVolume(VolumeInfo info, VoxelCoding coding, RawLabel fill,
                std::unique_ptr<ChunkSource> source, std::uint64_t cache_bytes);

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override;
  [[nodiscard]] std::uint64_t buffer_bytes(int threads) const override;
  void drop_buffers() const override { cache_.clear(); }

 private:
  [[nodiscard]] Box3 box_of(Index3 chunk) const;
  [[nodiscard]] ChunkCache::Loaded load(Index3 chunk) const;
  void copy(const Chunk& chunk, const Box3& held, const Box3& part, const Box3& box,
            std::span<RawLabel> out) const;

  VolumeInfo info_;
  VoxelCoding coding_;
  RawLabel fill_;
  std::unique_ptr<ChunkSource> source_;
  std::uint64_t cache_bytes_;
  mutable ChunkCache cache_;
};

}  // namespace mw::io
