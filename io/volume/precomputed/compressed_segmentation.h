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

/// What a chunk does not say of itself.
struct SegmentationLayout {
  Index3 shape;                      ///< of the chunk
  Index3 block;                      ///< what is encoded as one
  VoxelType type = VoxelType::kU64;  ///< kU32 or kU64
};

/// The most that a block may have: tables are found by 24 bits.
inline constexpr std::int64_t kMaxBlockVoxels = 1 << 24;

/// The most bytes that a chunk needs: all blocks in 32 bits a voxel, each with a table of its own.
/// REQUIRES: the product of the block at most kMaxBlockVoxels.
[[nodiscard]] std::uint64_t max_segmentation_bytes(const SegmentationLayout& layout);

/// The voxels of a chunk of one channel, x fastest, least significant byte first.
/// name: what errors call the chunk.
/// Memory: what the shape needs.
/// ERRORS: mw::Error(kInput) naming the block where offsets or numbers of bits make no sense, or
/// lead out of the bytes.
[[nodiscard]] std::vector<std::byte> unpack_segmentation(std::span<const std::byte> packed,
                                                         const SegmentationLayout& layout,
                                                         std::string_view name);

}  // namespace mw::io
