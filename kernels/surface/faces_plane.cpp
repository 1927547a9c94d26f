// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sums moments of faces, voxel by voxel.
#include "kernels/surface/faces_plane.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "kernels/core/index.h"

namespace mw {
namespace {

/// The standard deviation of the weights, and how far faces count, in smallest edges of a voxel
/// (bench/parameters.md, "Lines").
constexpr double kSpread = 3.0, kReachOfFaces = 2.0 * kSpread;
constexpr double kLeastLook = 0.1, kMostUneven = 0.5, kLeastWidth = 0.8, kLeastCosine = 0.8;

/// Returns nearly exp(-x / 2).  The C library's exponential would differ between processors in its
/// last digits, and with it meshes; products do not.  REQUIRES: 0 <= x <= 4.
double weight_at(double x) {
  double out = 1.0 - x / 32.0;
  for (int doubling = 0; doubling < 4; ++doubling) out *= out;
  return out;
}

/// Sums over faces, of their weights, their places and the products of these.
struct FaceMoments {
  double weights = 0.0;
  Vec3 places = Vec3::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();

  void add(const Vec3& place, double look) {
    const double squared = place.squaredNorm();
    if (squared > kReachOfFaces * kReachOfFaces) return;
    const double weight = look * weight_at(squared / (kSpread * kSpread));
    weights += weight;
    places += weight * place;
    products += weight * place * place.transpose();
  }
};

/// The voxels that may have faces within reach on their upper sides.
Box3 voxels_within_reach(const LabelBox& labels, const Metric& metric, Point place) {
  const auto reach = [&](int axis) {
    return static_cast<std::int64_t>(std::ceil(kReachOfFaces / metric.voxel()[axis]));
  };
  const Index3 at{place.x / kUnitsPerVoxel, place.y / kUnitsPerVoxel, place.z / kUnitsPerVoxel};
  const Index3 around{reach(0), reach(1), reach(2)};
  return intersection(Box3{at - around, at + around + Index3{1, 1, 1}}, labels.box);
}

FaceMoments moments_of(const LabelBox& labels, const Metric& metric, Point place, LabelPair pair,
                       const Vec3& towards_high) {
  const Box3 near = voxels_within_reach(labels, metric, place);
  const Vec3 voxel = metric.voxel(), from = metric.vector({}, place);
  const Index3 shape = labels.box.shape();
  const std::array<std::int64_t, 3> strides{1, shape.x, shape.x * shape.y};
  FaceMoments out;
  if (near.lo.x >= near.hi.x || near.lo.y >= near.hi.y || near.lo.z >= near.hi.z) return out;
  for_each_index(near, [&](Index3 v) {
    const Label* const at = &labels.labels[static_cast<std::size_t>(labels.box.offset(v))];
    const Label lower = without_side(*at);
    if (lower != pair.low && lower != pair.high) return;
    const Label other = lower == pair.low ? pair.high : pair.low;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (along(v, axis) + 1 >= along(labels.box.hi, axis)) continue;
      if (without_side(at[strides[axis]]) != other) continue;
      const double cosine = towards_high[static_cast<int>(axis)];
      const double look = lower == pair.low ? cosine : -cosine;
      if (!(look > kLeastLook)) continue;
      Vec3 middle(static_cast<double>(v.x) + 0.5, static_cast<double>(v.y) + 0.5,
                  static_cast<double>(v.z) + 0.5);
      middle[static_cast<int>(axis)] += 0.5;
      out.add(middle.cwiseProduct(voxel) - from, look);
    }
  });
  return out;
}

}  // namespace

std::optional<FacesPlane> plane_of_faces(const LabelBox& labels, const Metric& metric, Point place,
                                         LabelPair pair, const Vec3& towards_high) {
  const FaceMoments sums = moments_of(labels, metric, place, pair, towards_high);
  if (!(sums.weights > 0.0)) return std::nullopt;
  const Vec3 centre = sums.places / sums.weights;
  const Eigen::Matrix3d spread = sums.products / sums.weights - centre * centre.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  const Vec3 normal = axes.eigenvectors().col(0);
  if (!(axes.eigenvalues()[0] <= kMostUneven * kMostUneven) ||
      !(axes.eigenvalues()[1] >= kLeastWidth * kLeastWidth) ||
      !(std::abs(normal.dot(towards_high)) >= kLeastCosine)) {
    return std::nullopt;
  }
  return FacesPlane{normal, normal.dot(centre)};
}

}  // namespace mw
