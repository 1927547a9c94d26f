// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The blocks after the last march, as the end of a run reads them.
#pragma once

#include "kernels/core/index.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// Reading leaves the blocks as they are, so it may happen more than once.
class FinalBlocks {
 public:
  virtual ~FinalBlocks() = default;
  /// A copy of the block.  Only vertices (id, position) and tets are looked at.
  [[nodiscard]] virtual BlockMesh load(Index3 block) = 0;
};

}  // namespace mw::engine
