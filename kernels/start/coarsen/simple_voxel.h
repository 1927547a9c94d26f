// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The test that lets one voxel change its label, from what neighbours cover of its surface.
#pragma once

#include <array>
#include <cstdint>

#include "kernels/core/label.h"

namespace mw {

/// A set of the 26 neighbours of a voxel: neighbour (dx, dy, dz) is bit
/// (dz + 1) * 9 + (dy + 1) * 3 + (dx + 1); bit 13, the voxel itself, is not used.
using NeighbourSet = std::uint32_t;

inline constexpr unsigned kSelf = 13;
inline constexpr NeighbourSet kAllNeighbours =
    ((NeighbourSet{1} << 27) - 1) & ~(NeighbourSet{1} << kSelf);

/// The closed cells of the voxel's surface (8 corners, 12 edges, 6 faces) that closed neighbour
/// voxels share with it.  The cell towards (dx, dy, dz) has the bit of that neighbour.
[[nodiscard]] NeighbourSet covered_cells(NeighbourSet neighbours);

/// True when the union of the cells is contractible: not empty, connected, Euler number 1.  A
/// closed part of a sphere with these properties has no hole, and is not the sphere.
/// REQUIRES: cells closed (with every cell its boundary), as covered_cells() makes them.
[[nodiscard]] bool is_contractible(NeighbourSet cells);

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
