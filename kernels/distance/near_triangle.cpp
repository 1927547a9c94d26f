// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Near a point tests boxes first, then distances, then whether the triangle is an interface.
#include "kernels/distance/interface_fan.h"

#include <algorithm>
#include <cmath>

namespace mw {
namespace {

/// A factor that exceeds the rounding of distances.
constexpr double kRoundedUp = 1.0 + 1e-9;

std::int32_t units(double voxels) {
  return static_cast<std::int32_t>(std::lround(voxels * kUnitsPerVoxel));
}

/// True if a tet of this label has the triangle (v, a, b).
bool has_tet(const TetMesh& mesh, LocalVertex v, LocalVertex a, LocalVertex b, Label label) {
  const auto star = mesh.star(v);
  return std::any_of(star.begin(), star.end(), [&](const LinkTriangle& t) {
    return without_side(t.label) == label && t.has(a) && t.has(b);
  });
}

}  // namespace

bool NearTriangle::may_be_at(const TetMesh& mesh, std::span<const LocalVertex> vertices,
                             const std::array<LocalVertex, 2>& without, const Wanted& wanted) {
  const double reach = wanted.limit + 1.0 / kUnitsPerVoxel;
  const Vec3& p = wanted.point;
  lo_ = {units(p[0] - reach), units(p[1] - reach), units(p[2] - reach)};
  hi_ = {units(p[0] + reach), units(p[1] + reach), units(p[2] + reach)};
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](LocalVertex v) { return may_be_at(mesh, v, without, wanted); });
}

/// A bit for each side of the box that p is beyond.
unsigned NearTriangle::sides_of(Point p) const {
  return (p.x < lo_.x ? 1U : 0U) | (p.x > hi_.x ? 2U : 0U) | (p.y < lo_.y ? 4U : 0U) |
         (p.y > hi_.y ? 8U : 0U) | (p.z < lo_.z ? 16U : 0U) | (p.z > hi_.z ? 32U : 0U);
}

bool NearTriangle::may_be_at(const TetMesh& mesh, LocalVertex v,
                             const std::array<LocalVertex, 2>& without,
                             const Wanted& wanted) const {
  const std::uint64_t both = mesh.label_bit(wanted.low) | mesh.label_bit(wanted.high);
  // Both labels of an interface triangle lie at each of its corners.
  const auto may_have = [&](LocalVertex w) {
    return (mesh.label_signature(w) & both) == both && w != without[0] && w != without[1];
  };
  if (!may_have(v)) return false;
  const Vec3 at = in_voxels(mesh.position(v));
  const unsigned beyond = sides_of(mesh.position(v));
  const double limit = kRoundedUp * wanted.limit;
  const auto is_near = [&](LocalVertex a, LocalVertex b, unsigned sides) {
    if ((beyond & sides) != 0 || !may_have(a) || !may_have(b)) return false;
    const DistanceTriangle shape({at, in_voxels(mesh.position(a)), in_voxels(mesh.position(b))});
    return shape.squared_distance(wanted.point) <= limit * limit &&
           has_tet(mesh, v, a, b, wanted.high);
  };
  for (const LinkTriangle& t : mesh.star(v)) {
    if (without_side(t.label) != wanted.low) continue;
    const unsigned a = sides_of(mesh.position(t.a)), b = sides_of(mesh.position(t.b)),
                   c = sides_of(mesh.position(t.c));
    if (is_near(t.a, t.b, a & b) || is_near(t.b, t.c, b & c) || is_near(t.c, t.a, c & a)) {
      return true;
    }
  }
  return false;
}

}  // namespace mw
