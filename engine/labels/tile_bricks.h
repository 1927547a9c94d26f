// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bricks cut out of larger boxes of labels.
#pragma once

#include <functional>
#include <span>

#include "io/labels/brick_volume.h"
#include "io/labels/label_table.h"
#include "kernels/core/label.h"

namespace mw::engine {

/// The bricks that a box of voxels touches.  REQUIRES: no voxel is below 0.
[[nodiscard]] Box3 bricks_over(const Box3& voxels);

/// Copies the voxels of a brick out of a larger box.
void cut_brick(const LabelBox& from, const Box3& brick, std::vector<Label>& out);

[[nodiscard]] LabelBox read_labels(const io::DenseVolume& volume, const Box3& box);

using OnBrick = std::function<void(Index3 brick, const Box3& box, std::span<const Label> voxels)>;

/// Calls visit for each brick of a tile.
/// REQUIRES: the tile begins at a brick, and ends at one or with the volume.
void for_each_brick(const LabelBox& tile, const OnBrick& visit);

}  // namespace mw::engine
