// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks chunks of Neuroglancer's compressed_segmentation encoding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "io/volume/label_volume.h"

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

}  // namespace mw::io
