// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The test that lets one voxel change its label.
#pragma once

#include <array>

#include "kernels/core/label.h"
#include "kernels/start/cube_surface.h"

namespace mw {

/// Labels of the 3 x 3 x 3 voxels around a voxel, in the numbering of NeighbourSet.
using Neighbourhood = std::array<Label, 27>;

/// True when giving the middle voxel v the label `to` provably keeps the homotopy type of the
/// closed and of the open region of every label, the exterior included (kernels/start/README.md,
/// "One voxel changes its label").
///
/// The closed region of its old label L loses the cube v, which met the rest in the part X of its
/// surface that neighbours of label L cover: when X is contractible, so is the change (a
/// contractible piece glued along a contractible set).  The closure of all other labels gains v,
/// glued along what the other neighbours cover; its complement is the open region of L.  The same
/// two conditions for `to`, with loss and gain exchanged.  All other labels and their complements
/// stay the same sets.
/// REQUIRES: to differs from the present label; neither is kExterior.
[[nodiscard]] bool relabel_keeps_topology(const Neighbourhood& labels, Label to);

}  // namespace mw
