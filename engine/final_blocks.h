// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The blocks after the last march, as the end of a run reads them.
#pragma once

#include "engine/block_store.h"

namespace mw::engine {

/// Reading leaves the blocks as they are, so it may happen more than once.
class FinalBlocks {
 public:
  virtual ~FinalBlocks() = default;
  /// A copy of the block.  Only vertices (id, position) and tets are looked at.
  [[nodiscard]] virtual BlockMesh load(Index3 block) = 0;
};

/// What rests in a store.  REQUIRES: every block has been put; nobody else uses the store
/// meanwhile.
class StoredBlocks : public FinalBlocks {
 public:
  explicit StoredBlocks(BlockStore& store) : store_(store) {}

  [[nodiscard]] BlockMesh load(Index3 block) override {
    BlockMesh mesh = store_.take(block).value();
    BlockMesh copy{.vertices = mesh.vertices, .tets = mesh.tets, .samples = {}};
    store_.put(block, std::move(mesh));
    return copy;
  }

 private:
  BlockStore& store_;
};

}  // namespace mw::engine
