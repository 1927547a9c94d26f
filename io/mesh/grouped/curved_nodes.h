// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Curved interfaces: where the ten nodes of each tet lie, and how far the tets at a node allow it
// to move.
#pragma once

#include <limits>

#include "io/file/scratch/scratch_file.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// What becomes of the nodes that curve_nodes() places.
struct CurveRule {
  /// They are corners of straight tets, the parts of halved_tet(), and not nodes of curved ones.
  bool has_straight_parts = false;
  /// No node moves farther.
  double most_move = std::numeric_limits<double>::infinity();
};

/// Finds places for all nodes of a mesh with middles, from its straight tets alone.
///
/// Interfaces of straight triangles that enclose the right volume have their corners outside of a
/// smooth convex surface, and the middles of their edges on it or inside.  Here both come to lie on
/// the surface, as a normal at each corner tells it (Max 1999): an edge bulges as a parabola with
/// these normals at its ends does, and a corner goes back by the mean bulge of its edges.  Then
/// corners move along their normals until the volume on each side of the surface is what it was,
/// corner by corner.
///
/// Where the header knows places of an interface (MeshHeader::interface_place), corners and middles
/// inside of it go there instead, and its volume is that of the curved triangles between them:
/// straight parts keep it, too, by corners that move along their normals.
///
/// Where an interface ends (at other labels, or in the box) and where it bends by more than 60
/// degrees its edges form lines.  These are curved likewise, by tangents; in a side of the box they
/// stay in it.  Corners at the ends of lines stay, and so does a side of a periodic box.
///
/// ENSURES: the Jacobian of each curved tet is at least kLeastJacobian of what it was, everywhere
/// in it, proven by its Bernstein coefficients, and so are the parts of kTetParts; the straight
/// tets between the corners keep the quality floor of the mesh's record, which is kCurvedFloor of
/// the straight mesh's.  Straight parts have at least kLeastJacobian of the volume that they had,
/// and the radius ratio that halved_floor() tells.  Where this would break, nodes go half the way,
/// a quarter, or nowhere.  Edges inside of labels are straight, with their nodes in the middle.
/// Memory: 24 MiB.  Disk: some 400 bytes a vertex and 120 an edge.
/// ERRORS: see ScratchFile.
/// REQUIRES: facets and middles were found; no vertex is doubled.
[[nodiscard]] PagedArray<Position> curve_nodes(GroupedMesh& mesh,
                                               const std::filesystem::path& folder,
                                               const CurveRule& rule);

/// The least share of six times a straight tet's volume that the Jacobian of the curved one keeps.
inline constexpr double kLeastJacobian = 0.1;
/// The share of the quality floor that the straight tets between the corners keep.
inline constexpr double kCurvedFloor = 0.5;

/// Where a node is to go from its place in the straight mesh.
struct NodeMove {
  Position move{};
  bool has_own = false;       ///< the node is a middle that does not follow from its corners
  std::uint8_t shorter = 0;   ///< how far it goes: 0 all the way, 1 half, 2 a quarter, 3 nowhere
  bool is_held_back = false;  ///< it goes less far from the next round on
  bool was_changed = false;   ///< `shorter` was changed in the last round
};

/// Returns the places of all nodes.  While the moves would spoil tets, which then break what
/// curve_nodes() ensures, the node that goes farthest in each of these goes less far.
[[nodiscard]] PagedArray<Position> straightened(GroupedMesh& mesh, PagedArray<NodeMove> moves,
                                                const std::filesystem::path& folder,
                                                bool has_straight_parts);

}  // namespace mw::io
