// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels windows need when this process visits only some windows of a run.
#pragma once

#include "engine/settings/settings.h"
#include "kernels/core/index.h"

namespace mw::engine {

/// Boxes of voxels; empty (lo = hi) where nothing is needed.
struct LabelNeed {
  Box3 starts;  ///< start meshes are made for blocks in this box
  Box3 near;    ///< visits look at the input's labels in this box
};

/// The boxes of bricks of 16^3 voxels that are needed; each lies inside the one before.
struct NeededBricks {
  Box3 original;  ///< bricks that are read
  Box3 shapes;    ///< bricks that are coarsened
  Box3 levels;    ///< bricks whose large cells are found
};

/// True if start meshes take their shape from coarsened labels.
[[nodiscard]] bool is_coarsened(const MeshSettings& settings);

/// True if interfaces are fitted to a SourceSurface: with smooth surfaces and a bound on distances,
/// where edges have sizes or labels have scores (io::LabelScores).  Otherwise voxel faces are good
/// enough, since triangles are large beside them.
[[nodiscard]] bool wants_source(const MeshSettings& settings, bool has_scores);

[[nodiscard]] NeededBricks bricks_of(Index3 volume);
/// Returns the bricks that are needed.  With limits on edges these are all bricks, as how far a
/// limit reaches depends on its gradation and on the labels of the whole volume.
[[nodiscard]] NeededBricks bricks_of(const LabelNeed& need, Index3 volume,
                                     const MeshSettings& settings);

}  // namespace mw::engine
