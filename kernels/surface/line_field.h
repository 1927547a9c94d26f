// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lines along which three labels meet, and where a smooth line would have a vertex.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kernels/core/metric.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Where a smooth line would have a vertex, and how the line runs there.
struct LinePlace {
  Vec3 place;          ///< from the vertex, metric units
  Vec3 direction;      ///< unit vector from one neighbour on the line to the other
  double edge = 0.0;   ///< mean length of the line's two edges at the vertex, metric units
  double share = 1.0;  ///< how much the place counts, 1 where few vertices tell it
};

/// The edges that have three labels around them or more, the exterior included.  A vertex is on a
/// line where exactly two such edges meet.  Where one meets, or more than two do, lines end.
/// Neighbours are those at the time of find(); they stay right while vertices move.
class LineField {
 public:
  /// Finds the neighbours on lines of all free vertices.
  void find(const TetMesh& mesh);

  /// Returns where a curve along the line has the vertex: a cubic over the lengths of the edges, so
  /// that a line of even curvature keeps it.
  ///
  /// Where more than four vertices lie within six voxels along the line, and are within 0.25 voxel
  /// of a cubic in the mean, it is that cubic (least squares, weights that fall to nothing at six
  /// voxels), and the place counts twice.  The zigzag of the voxels is some voxels long, so a curve
  /// through the nearest vertices alone follows it where edges are short.  Otherwise the curve goes
  /// through the two neighbours on each side; where one of the two neighbours is an end, it is the
  /// parabola through the other three vertices.
  ///
  /// Returns nothing where both are ends, and where v is on no line.
  [[nodiscard]] std::optional<LinePlace> place(const TetMesh& mesh, const Metric& metric,
                                               LocalVertex v) const;

 private:
  using Pair = std::array<LocalVertex, 2>;

  [[nodiscard]] bool has(LocalVertex v) const {
    return v < neighbours_.size() && neighbours_[v][0] != v;
  }
  [[nodiscard]] std::optional<LocalVertex> beyond(LocalVertex v, LocalVertex from) const;

  std::vector<Pair> neighbours_;  ///< twice the vertex itself where it is on no line
};

}  // namespace mw
