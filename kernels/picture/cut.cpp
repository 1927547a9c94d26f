// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Triangles and tets cut by a plane.
#include "kernels/picture/cut.h"

namespace mw::picture {
namespace {

/// Where the edge from a point that stays to one that goes meets the plane.  The ends always come
/// in this order, so that all tets and triangles that share the edge get the same point.
Vec3 crossing(const Vec3& stays, const Vec3& goes, const CutPlane& plane) {
  const double a = plane.height(stays), b = plane.height(goes);
  return stays + (goes - stays) * (a / (a - b));
}

}  // namespace

Piece clipped(const std::array<Vec3, 3>& triangle, const CutPlane& plane) {
  Piece out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& p = triangle[i];
    const Vec3& q = triangle[(i + 1) % 3];
    const bool p_stays = plane.height(p) <= 0, q_stays = plane.height(q) <= 0;
    if (p_stays) out.add(p);
    if (p_stays != q_stays) out.add(p_stays ? crossing(p, q, plane) : crossing(q, p, plane));
  }
  return out;
}

Piece cross_section(const std::array<Vec3, 4>& tet, const CutPlane& plane) {
  std::array<const Vec3*, 4> stay{}, go{};
  std::size_t stays = 0, goes = 0;
  for (const Vec3& corner : tet) {
    (plane.height(corner) <= 0 ? stay[stays++] : go[goes++]) = &corner;
  }
  Piece out;
  if (stays == 2) {
    // The corners go around the tet, so that neighbours share a face.
    for (const auto& [s, g] : {std::pair(0, 0), std::pair(0, 1), std::pair(1, 1), std::pair(1, 0)})
      out.add(
          crossing(*stay[static_cast<std::size_t>(s)], *go[static_cast<std::size_t>(g)], plane));
    return out;
  }
  for (std::size_t s = 0; s < stays && goes > 0; ++s) {
    for (std::size_t g = 0; g < goes; ++g) out.add(crossing(*stay[s], *go[g], plane));
  }
  return out;
}

}  // namespace mw::picture
