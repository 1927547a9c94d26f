// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The quadric of corners of coarsened labels, against explicit planes.
#include "kernels/start/corner_quadric.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/kernels/start/coarsen/coarse_volume.h"

namespace mw::test {
namespace {

Vec3 real(Index3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// The faces between two labels: centres and normals, from the smaller label to
/// the larger.
struct Sheet {
  std::vector<Vec3> centres;
  Vec3 normals = Vec3::Zero();

  /// Returns the squared distance of x from the sheet, times its faces.  x, voxel: physical units.
  [[nodiscard]] double squared_distance(const Vec3& x, const Vec3& voxel) const {
    if (normals.norm() == 0.0) return 0.0;
    Vec3 mean = Vec3::Zero();
    for (const Vec3& c : centres) mean += c.cwiseProduct(voxel);
    mean /= static_cast<double>(centres.size());
    const Vec3 areas(voxel[1] * voxel[2], voxel[0] * voxel[2], voxel[0] * voxel[1]);
    return std::pow(normals.cwiseProduct(areas).normalized().dot(x - mean), 2) * normals.norm();
  }
};

/// Voxel centres lie half a voxel off the corners; a face's centre is in the
/// middle of two.
std::map<std::pair<Label, Label>, Sheet> sheets_around(const StartLabels& labels, Index3 corner) {
  std::set<Label> meet;
  for_each_index(Box3{corner - Index3{1, 1, 1}, corner + Index3{1, 1, 1}},
                 [&](Index3 v) { meet.insert(labels.shape.at(v)); });
  meet.erase(kExterior);
  const Box3 wide{corner - Index3{2, 2, 2}, corner + Index3{2, 2, 2}};
  std::map<std::pair<Label, Label>, Sheet> out;
  for_each_index(wide, [&](Index3 v) {
    for (const Index3& step : {Index3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
      const Index3 w = v + step;
      if (!wide.contains(w)) continue;
      const Label a = labels.original.at(v), b = labels.original.at(w);
      if (a == b || meet.count(a) == 0 || meet.count(b) == 0) continue;
      Sheet& sheet = out[std::minmax(a, b)];
      sheet.centres.push_back(0.5 * (real(v - corner) + real(w - corner)) + Vec3(0.5, 0.5, 0.5));
      sheet.normals += a < b ? real(step) : real(Index3{0, 0, 0} - step);
    }
  });
  return out;
}

bool is_inner(const LabelBox& shape, Index3 corner) {
  std::set<Label> meet;
  for_each_index(Box3{corner - Index3{1, 1, 1}, corner + Index3{1, 1, 1}},
                 [&](Index3 v) { meet.insert(shape.at(v)); });
  return meet.size() == 1;
}

TEST(Sec52Quadrics, OfCoarseCornersMeasureMeanPlanesOfTheInput) {
  std::mt19937 random(1041);
  const QuadricWeights weights{.plane = 0.75, .boundary_point = 0.25, .inner_point = 0.5};
  const std::array<Vec3, 5> offsets{
      {{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}, {0, 0, -2}, {0.25, -0.5, 1.5}}};
  int planes = 0, inner_corners = 0;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
    const Index3 shape{4 + below(random, 5), 3 + below(random, 5), 2 + below(random, 5)};
    const SmallVolume volume = random_volume_of(random, kind, shape, 1 + below(random, 4));
    const Box3 wide{{-3, -3, -3}, shape + Index3{3, 3, 3}};
    const LabelBox original = labels_in(volume, wide);
    const LabelBox coarse = labels_in(coarsened(volume, 1.5), wide);
    const StartLabels labels{.shape = coarse, .original = original};
    const Vec3 voxel = i % 2 == 0 ? Vec3(1.0, 1.0, 1.0) : Vec3(1.0, 4.0, 2.5);
    const StartOptions options{.weights = weights,
                               .metric = Metric({voxel[0], voxel[1], voxel[2]})};
    for_each_index(shape + Index3{1, 1, 1}, [&](Index3 corner) {
      const Quadric q = wide_quadric(labels, corner, options);
      const bool inner = is_inner(coarse, corner);
      inner_corners += inner ? 1 : 0;
      for (const Vec3& x : offsets) {
        double expected = (inner ? weights.inner_point : weights.boundary_point) * x.squaredNorm();
        if (!inner) {
          for (const auto& [pair, sheet] : sheets_around(labels, corner)) {
            expected += weights.plane * sheet.squared_distance(x, voxel);
            ++planes;
          }
        }
        ASSERT_NEAR(q.value(x), expected, 1e-12 * (1.0 + expected));
      }
    });
  }
  EXPECT_GT(planes, 10000);
  EXPECT_GT(inner_corners, 200);
}

/// On a flat interface nothing pulls a corner away from it, whichever way it
/// lies.
TEST(Sec52Quadrics, OfCoarseCornersAreZeroOnFlatInterfaces) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    const SmallVolume volume = volume_from({8, 8, 8}, 2, [&](auto x, auto y, auto z) {
      return (axis == 0 ? x : axis == 1 ? y : z) < 4 ? 0 : 1;
    });
    const LabelBox all = labels_in(volume, {{0, 0, 0}, {8, 8, 8}});
    const Quadric q = wide_quadric({.shape = all, .original = all}, {4, 4, 4},
                                   {.weights = {1.0, 0.0, 0.0}, .metric = {}});
    for (unsigned k = 0; k < 3; ++k) {
      const Vec3 step = 0.75 * Vec3::Unit(k);
      // Sixteen faces of the 4^3 voxels lie between the labels.
      EXPECT_NEAR(q.value(step), k == axis ? 16.0 * 0.75 * 0.75 : 0.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace mw::test
