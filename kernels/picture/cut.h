// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Triangles and tets cut by a plane.
#pragma once

#include <span>

#include "kernels/core/metric.h"

namespace mw::picture {

/// Points with normal . p <= offset stay.
struct CutPlane {
  Vec3 normal;
  double offset = 0;

  [[nodiscard]] double height(const Vec3& p) const { return normal.dot(p) - offset; }
};

/// A convex polygon of three or four corners, or nothing.
struct Piece {
  std::array<Vec3, 4> corners;
  std::size_t count = 0;

  void add(const Vec3& corner) { corners[count++] = corner; }
};

/// The part of a triangle that stays, in its orientation.
[[nodiscard]] Piece clipped(const std::array<Vec3, 3>& triangle, const CutPlane& plane);

/// The part of the plane that is in the tet.  Where faces of tets lie in the plane, only the tets
/// beyond it have them, so that the pieces of a mesh cover its cut once.
[[nodiscard]] Piece cross_section(const std::array<Vec3, 4>& tet, const CutPlane& plane);

}  // namespace mw::picture
