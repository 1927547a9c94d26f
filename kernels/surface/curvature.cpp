// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Change of area over change of volume, when a vertex moves along the normal.
#include "kernels/surface/curvature.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace mw {
namespace {

/// 1 / voxel: what is sharper than a ball of a few voxels is no shape but a step.
constexpr double kMostCurvature = 0.25;

}  // namespace

Vec3 area_gradient(const SurfaceStar& star) {
  Vec3 gradient = Vec3::Zero();
  for (const SurfaceTriangle& t : star.triangles()) {
    const Vec3 normal = t.normal(Vec3::Zero());
    const double length = normal.norm();
    if (length > 0.0) gradient += 0.5 / length * normal.cross(t.to_b - t.to_a);
  }
  return gradient;
}

void CurvatureField::measure(const TetMesh& mesh, const Metric& metric) {
  known_.assign(mesh.vertex_count(), 0);
  curvature_.resize(mesh.vertex_count());
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || !mesh.is_free(v)) continue;
    if (mesh.order(v) != 2 || mesh.planes(v) != 0) continue;
    star_.collect(mesh, metric, v);
    Vec3 volume_gradient = Vec3::Zero();
    for (const SurfaceTriangle& t : star_.triangles()) {
      volume_gradient += t.normal(Vec3::Zero()) / 6.0;
    }
    const double square = volume_gradient.squaredNorm();
    if (!(square > 0.0)) continue;
    known_[v] = 1;
    curvature_[v] = std::clamp(area_gradient(star_).dot(volume_gradient) / square, -kMostCurvature,
                               kMostCurvature);
  }
}

}  // namespace mw
