// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which part of a voxel's surface some of its neighbours cover, and whether it is contractible.
#pragma once

#include <cstdint>

namespace mw {

/// A set of the 26 neighbours of a voxel: neighbour (dx, dy, dz) is bit
/// (dz + 1) * 9 + (dy + 1) * 3 + (dx + 1); bit 13, the voxel itself, is not used.
using NeighbourSet = std::uint32_t;

inline constexpr unsigned kSelf = 13;
inline constexpr NeighbourSet kAllNeighbours =
    ((NeighbourSet{1} << 27) - 1) & ~(NeighbourSet{1} << kSelf);

/// The closed cells of the voxel's surface (8 corners, 12 edges, 6 faces) that closed neighbour
/// voxels share with it, in the same numbering: the cell towards (dx, dy, dz).
[[nodiscard]] NeighbourSet covered_cells(NeighbourSet neighbours);

/// True when the union of the cells is contractible: not empty, connected, Euler number 1.  A
/// closed part of a sphere with these has no hole, and is not the sphere.
/// REQUIRES: cells closed (with every cell its boundary), as covered_cells() makes them.
[[nodiscard]] bool is_contractible(NeighbourSet cells);

}  // namespace mw
