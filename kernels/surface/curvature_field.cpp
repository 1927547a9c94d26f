// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Change of area over change of volume, when a vertex moves along the normal.
#include "kernels/surface/curvature_field.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace mw {
namespace {

/// 1 / voxel: what is sharper than a ball of a few voxels is no shape but a step.
constexpr double kMaxCurvature = 0.5;
/// Where it cannot be told.
constexpr double kUnknown = 2.0 * kMaxCurvature;

double curvature_of(const SurfaceStar& star) {
  Vec3 volume_gradient = Vec3::Zero(), area_gradient = Vec3::Zero();
  for (const SurfaceTriangle& t : star.triangles()) {
    const Vec3 normal = t.normal(Vec3::Zero());
    const double length = normal.norm();
    if (!(length > 0.0)) continue;
    volume_gradient += normal / 6.0;
    area_gradient += 0.5 / length * normal.cross(t.to_b - t.to_a);
  }
  const double square = volume_gradient.squaredNorm();
  if (!(square > 0.0)) return kUnknown;
  return std::clamp(area_gradient.dot(volume_gradient) / square, -kMaxCurvature, kMaxCurvature);
}

}  // namespace

void CurvatureField::measure(const TetMesh& mesh, const Metric& metric) {
  curvature_.assign(mesh.vertex_count(), kUnknown);
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || !mesh.is_free(v)) continue;
    if (mesh.order(v) != 2 || mesh.planes(v) != 0) continue;
    star_.collect(mesh, metric, v);
    curvature_[v] = curvature_of(star_);
  }
}

std::optional<double> CurvatureField::at(LocalVertex v) const {
  if (v >= curvature_.size() || curvature_[v] == kUnknown) return std::nullopt;
  return curvature_[v];
}

}  // namespace mw
