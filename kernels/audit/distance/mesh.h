// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The mesh's interface: its triangles between labels, and smaller pieces of them.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernels/audit/distance/trees.h"
#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// A triangle with different labels on its sides.
struct InterfaceTriangle {
  VoxelTriangle corners{};
  LabelPair labels{};
};

/// Returns every triangle between two labels that the tile owns; label_count stands for labels that
/// the volume does not have.  With gaps, every triangle of one tet that is not on the box counts as
/// one between its label and label_count + 1.  Vertices farther outside the box than its longest
/// edge are moved to that distance (such a mesh fails P2 anyway).
/// REQUIRES: finite vertices; frame and shape are those of the lattice that distances count in.
[[nodiscard]] std::vector<InterfaceTriangle> interface_triangles(const MeshStars& stars,
                                                                 std::size_t label_count,
                                                                 const Frame& frame, Index3 shape,
                                                                 bool with_gaps = false);

/// Sorts along a space-filling curve through the box, and by content at equal places.
void sort_along_curve(std::vector<InterfaceTriangle>& triangles, const Box3& box);

[[nodiscard]] double area(const VoxelTriangle& t);
[[nodiscard]] VoxelPoint centroid(const VoxelTriangle& t);
/// Distance from the centroid to the farthest corner.
[[nodiscard]] double radius(const VoxelTriangle& t);
/// The two halves that a cut through the middle of the longest edge makes.
[[nodiscard]] std::array<VoxelTriangle, 2> halves(const VoxelTriangle& t);

/// Pieces of triangles have at most this radius, unless there would be too many.
inline constexpr double kPieceRadius = 2;

/// Calls visit(VoxelTriangle) for pieces of radius `max` at most that make up the triangle.
template <class Visit>
void for_each_piece(const VoxelTriangle& t, double max, Visit&& visit) {
  if (radius(t) <= max) {
    visit(t);
    return;
  }
  for (const VoxelTriangle& half : halves(t)) for_each_piece(half, max, visit);
}

/// About how many pieces triangles make, by radius: kPieceRadius, twice that, and so on.
using PieceEstimates = std::array<double, 20>;
void add_estimates(const VoxelTriangle& t, PieceEstimates& sums);

/// The smallest of these radii for which there are not too many pieces: kPieceRadius, except for
/// meshes with more interface than any valid one.
[[nodiscard]] double piece_radius(const PieceEstimates& sums);

}  // namespace mw::audit
