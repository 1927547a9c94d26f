// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether any interface triangle of two labels is near a point, without a list of them.
#pragma once

#include <span>

#include "kernels/distance/point_triangle.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Among the samples that no changed triangle takes nineteen in twenty find no unchanged one either
/// (an abdomen CT), and listing those triangles costs more than this look.
class NearTriangle {
 public:
  struct Wanted {
    Vec3 point;          ///< in voxels
    double limit = 0.0;  ///< of the distance
    Label low = 0;
    Label high = 0;
  };

  /// Whether a triangle between low and high at one of `vertices`, none of its corners being
  /// `without`, may be within the limit: false only when none is.
  /// REQUIRES: no vertex of `vertices` is in `without`.
  [[nodiscard]] bool may_be_at(const TetMesh& mesh, std::span<const LocalVertex> vertices,
                               const std::array<LocalVertex, 2>& without, const Wanted& wanted);

 private:
  [[nodiscard]] bool may_be_at(const TetMesh& mesh, LocalVertex v,
                               const std::array<LocalVertex, 2>& without,
                               const Wanted& wanted) const;
  [[nodiscard]] unsigned sides_of(Point p) const;

  Point lo_{}, hi_{};  ///< what is within the limit lies between
};

}  // namespace mw
