// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bounds by measured factors.
#include "engine/window_memory.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kMebibyte = 1 << 20;
// The most that any volume took (noise, where every voxel has a label of its own; connectome and
// CT take a third of it), from start mesh to scatter.
constexpr std::uint64_t kBytesPerStartVoxel = 2900;
constexpr std::uint64_t kBytesPerStoredByte = 6;
constexpr std::uint64_t kBytesPerLabelVoxel = 16;
// Code, libraries, and a tile of labels that is being coarsened.
constexpr std::uint64_t kProgramBytes = 32 * kMebibyte;
// What PreparedLabels holds for each 16^3 voxels: two bricks' places and the large cells.
constexpr std::uint64_t kBytesPerBrick = 20;
constexpr std::int64_t kBrickVoxels = 16 * 16 * 16;
constexpr std::uint64_t kBytesPerLabel = 64;

std::uint64_t voxels_of(const WindowGrid& grid, Index3 block) {
  return static_cast<std::uint64_t>(grid.block_box(block).voxels());
}

}  // namespace

std::uint64_t window_bytes(const WindowGrid& grid, Index3 window, const BlockStore& store) {
  std::uint64_t sum = store.taken_bytes(window) * kBytesPerStoredByte;
  for (Index3 block : grid.blocks_of(window)) {
    const bool fresh = store.loaded_bytes(block) == 0;
    sum += voxels_of(grid, block) * (kBytesPerLabelVoxel + (fresh ? kBytesPerStartVoxel : 0));
  }
  return sum;
}

std::uint64_t start_window_bytes(const WindowGrid& grid) {
  std::uint64_t sum = 0;
  for (Index3 block : grid.blocks_of({0, 0, 0})) {
    sum += voxels_of(grid, block) * (kBytesPerLabelVoxel + kBytesPerStartVoxel);
  }
  return sum;
}

std::uint64_t program_bytes(const io::DenseVolume& volume) {
  const auto bricks = static_cast<std::uint64_t>(volume.info().shape.product() / kBrickVoxels);
  return kProgramBytes + kBytesPerBrick * bricks + kBytesPerLabel * volume.table().size();
}

}  // namespace mw::engine
