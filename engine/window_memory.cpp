// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bounds by measured factors.
#include "engine/window_memory.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kMebibyte = 1 << 20;
constexpr std::uint64_t kBytesPerStartVoxel = 1000;
constexpr std::uint64_t kBytesPerStoredByte = 6;
constexpr std::uint64_t kBytesPerLabelVoxel = 16;
constexpr std::uint64_t kProgramBytes = 24 * kMebibyte;
constexpr std::uint64_t kBytesPerLabel = 64;

}  // namespace

std::uint64_t window_bytes(const WindowGrid& grid, Index3 window, const BlockStore& store,
                           const MeshSettings& settings) {
  static_cast<void>(settings);
  std::uint64_t fresh = 0, all = 0;
  for (Index3 block : grid.blocks_of(window)) {
    const auto voxels = static_cast<std::uint64_t>(grid.block_box(block).voxels());
    if (store.loaded_bytes(block) == 0) fresh += voxels;
    all += voxels;
  }
  return fresh * kBytesPerStartVoxel + store.taken_bytes(window) * kBytesPerStoredByte +
         all * kBytesPerLabelVoxel;
}

std::uint64_t program_bytes(const io::DenseVolume& volume) {
  return kProgramBytes + kBytesPerLabel * volume.table().size();
}

}  // namespace mw::engine
