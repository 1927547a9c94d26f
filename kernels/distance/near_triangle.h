// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether any interface triangle of two labels is near a point, without a list of them.
#pragma once

#include <span>

#include "kernels/distance/point_triangle.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// A quick test before the interface triangles around a change are listed.  Of the samples that no
/// changed triangle takes, nineteen in twenty find no unchanged one either (an abdomen CT), and the
/// list costs more than this test.
class NearTriangle {
 public:
  struct Wanted {
    Vec3 point;          ///< in voxels
    double limit = 0.0;  ///< the largest distance
    Label low = 0;
    Label high = 0;
  };

  /// Returns false only when no triangle between low and high is within the limit, of those that
  /// are at one of `vertices` and have no corner in `without`.
  /// REQUIRES: no vertex of `vertices` is in `without`.
  [[nodiscard]] bool may_be_at(const TetMesh& mesh, std::span<const LocalVertex> vertices,
                               const std::array<LocalVertex, 2>& without, const Wanted& wanted);

 private:
  [[nodiscard]] bool may_be_at(const TetMesh& mesh, LocalVertex v,
                               const std::array<LocalVertex, 2>& without,
                               const Wanted& wanted) const;
  [[nodiscard]] unsigned sides_of(Point p) const;

  Point lo_{}, hi_{};  ///< corners of a box of all that is within the limit
};

}  // namespace mw
