// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels windows need, when only some windows of a run are visited here.
#pragma once

#include "engine/settings/settings.h"
#include "kernels/core/index.h"

namespace mw::engine {

/// Boxes of voxels; empty (lo = hi) where nothing is needed.
struct LabelNeed {
  Box3 starts;  ///< start meshes are made of blocks in it
  Box3 near;    ///< visits look at the input's labels in it
};

/// The boxes of bricks of 16^3 voxels that are needed; each lies inside the one before.
struct NeededBricks {
  Box3 original;  ///< bricks that are read
  Box3 shapes;    ///< bricks that are coarsened
  Box3 levels;    ///< bricks whose large cells are found
};

/// True if start meshes take their shape from coarsened labels.
[[nodiscard]] bool is_coarsened(const MeshSettings& settings);

/// Whether interfaces are fitted to a SourceSurface: where edges have sizes, or labels have scores
/// (io::LabelScores).  Else voxel faces are good enough for triangles that are large beside them.
[[nodiscard]] bool wants_source(const MeshSettings& settings, bool has_scores);

[[nodiscard]] NeededBricks bricks_of(Index3 volume);
/// Returns the bricks that are needed.  With limits on edges these are all: how far such a limit
/// reaches depends on its gradation and on the labels of the whole volume.
[[nodiscard]] NeededBricks bricks_of(const LabelNeed& need, Index3 volume,
                                     const MeshSettings& settings);

}  // namespace mw::engine
