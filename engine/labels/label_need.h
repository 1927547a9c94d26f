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

/// The boxes of bricks of 16^3 voxels that are needed, each inside the one before.
struct NeededBricks {
  Box3 original;  ///< are read
  Box3 shapes;    ///< are coarsened
  Box3 levels;    ///< have their large cells found
};

/// Whether start meshes take their shape from coarsened labels.
[[nodiscard]] bool is_coarsened(const MeshSettings& settings);

/// Whether interfaces are fitted to a SourceSurface: where edges have sizes.  Voxel faces are good
/// enough for triangles that are large beside them.
[[nodiscard]] bool wants_source(const MeshSettings& settings);

[[nodiscard]] NeededBricks bricks_of(Index3 volume);
/// With limits on edges all bricks: such a limit reaches as far as its gradation lets it, and how
/// far that is only the labels of the whole volume tell.
[[nodiscard]] NeededBricks bricks_of(const LabelNeed& need, Index3 volume,
                                     const MeshSettings& settings);

/// The smallest box that has both; an empty one adds nothing.
[[nodiscard]] Box3 hull(const Box3& a, const Box3& b);

}  // namespace mw::engine
