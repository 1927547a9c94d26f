// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where blocks rest between the visits of windows (Sec 4.2).
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "engine/window_grid.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// Holds the blocks that windows have written.  A block is taken out by the one window that works
/// on it and put back by the same; a block that was never put is made from voxels by its first
/// window.  The store knows nothing of what a window does.
/// Thread safety: different blocks may be taken and put at the same time.
class BlockStore {
 public:
  virtual ~BlockStore() = default;

  /// Moves the block out; empty when it was never put.  REQUIRES: not taken already.
  [[nodiscard]] virtual std::optional<BlockMesh> take(Index3 block) = 0;
  /// REQUIRES: canonical.
  virtual void put(Index3 block, BlockMesh mesh) = 0;
};

/// Everything in memory.  Blocks are elements of their own of an array that never grows, so
/// different ones need no lock.
class MemoryBlockStore : public BlockStore {
 public:
  explicit MemoryBlockStore(Index3 blocks)
      : shape_(blocks), blocks_(static_cast<std::size_t>(blocks.product())) {}

  [[nodiscard]] std::optional<BlockMesh> take(Index3 block) override {
    return std::exchange(blocks_[raster(block, shape_)], std::nullopt);
  }
  void put(Index3 block, BlockMesh mesh) override {
    blocks_[raster(block, shape_)] = std::move(mesh);
  }

 private:
  Index3 shape_;
  std::vector<std::optional<BlockMesh>> blocks_;
};

}  // namespace mw::engine
