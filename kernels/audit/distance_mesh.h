// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The mesh's interface: its triangles between labels, and sample points on them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/audit/distance_shapes.h"
#include "kernels/audit/distance_trees.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// A triangle with different labels on its sides.
struct InterfaceTriangle {
  VoxelTriangle corners{};
  LabelPair labels{};
};

/// Every triangle between two labels, in the order of a space-filling curve.  Labels that the
/// volume does not have are label_count.  With gaps, also every triangle of one tet that is not on
/// the box, between its label and label_count + 1.  Vertices farther outside the box than its
/// longest edge are moved to that distance (such a mesh fails P2 anyway). REQUIRES: as MeshStars,
/// and finite vertices.  Errors: as MeshStars.
[[nodiscard]] std::vector<InterfaceTriangle> interface_triangles(const AuditMesh& mesh,
                                                                 std::size_t label_count,
                                                                 const Frame& frame, Index3 shape,
                                                                 bool with_gaps = false);

[[nodiscard]] double area(const VoxelTriangle& t);

/// Into how many equal parts each edge is divided for a covering radius in voxels: the samples are
/// the corners of the small triangles, and no point of a triangle is farther from all its corners
/// than the longest edge / sqrt 3.
[[nodiscard]] std::uint64_t parts_of_edge(const VoxelTriangle& t, double covering_radius);

/// The wanted radius, doubled until there are at most `most` samples more than one a corner.
[[nodiscard]] double affordable_radius(std::span<const InterfaceTriangle> triangles, double wanted,
                                       double most);

/// Calls visit(VoxelPoint) for all samples of one triangle.
template <class Visit>
void visit_triangle_samples(const VoxelTriangle& t, std::uint64_t parts, Visit&& visit) {
  const auto whole = static_cast<double>(parts);
  for (std::uint64_t i = 0; i <= parts; ++i) {
    for (std::uint64_t k = 0; i + k <= parts; ++k) {
      const double u = static_cast<double>(i) / whole;
      const double v = static_cast<double>(k) / whole;
      VoxelPoint p{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double base = t[0][axis];
        p[axis] = base + u * (t[1][axis] - base) + v * (t[2][axis] - base);
      }
      visit(p);
    }
  }
}

}  // namespace mw::audit
