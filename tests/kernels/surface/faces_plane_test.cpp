// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Planes of faces, of half-spaces that are known and beside a third label.
#include "kernels/surface/faces_plane.h"

#include <numbers>

#include "tests/kernels/surface/interface_triangles.h"
#include "tests/oracle/small_volumes.h"

namespace mw::test {
namespace {

using audit::test::below;

constexpr std::int64_t kEdge = 24;

/// Voxels take the label at their centres.
template <typename LabelAt>
LabelBox box_of(LabelAt label_at) {
  LabelBox out{{{0, 0, 0}, {kEdge, kEdge, kEdge}}, {}};
  for_each_index(out.box, [&](Index3 v) {
    const auto centre = [](std::int64_t i) { return static_cast<double>(i) + 0.5; };
    out.labels.push_back(label_at(Vec3(centre(v.x), centre(v.y), centre(v.z))));
  });
  return out;
}

Vec3 random_way(std::mt19937& random) {
  Vec3 out = Vec3::Zero();
  while (out.norm() < 0.1) {
    for (int i = 0; i < 3; ++i) out[i] = below(random, 2001) / 1000.0 - 1.0;
  }
  return out.normalized();
}

const Point kMiddle{12 * kUnitsPerVoxel, 12 * kUnitsPerVoxel, 12 * kUnitsPerVoxel};
const Vec3 kCentre(12, 12, 12);

/// The third label takes all faces on one side, and what is left tells the plane all the same.
TEST(FacesPlane, GoesOnBeyondALine) {
  std::mt19937 random(1221);
  double heights = 0.0, tilts = 0.0;
  constexpr int kPlanes = 60;
  for (int i = 0; i < kPlanes; ++i) {
    const Vec3 normal = random_way(random), side = normal.cross(random_way(random)).normalized();
    const double offset = below(random, 1000) / 1000.0 - 0.5;
    const LabelBox labels = box_of([&](const Vec3& p) {
      if ((p - kCentre).dot(side) > 0.0) return Label{7};
      return (p - kCentre).dot(normal) > offset ? Label{5} : Label{3};
    });
    const auto found = plane_of_faces(labels, Metric(), kMiddle, {3, 5}, normal);
    ASSERT_TRUE(found) << i;
    const double cosine = found->normal.dot(normal);
    heights += std::abs(found->height * (cosine > 0.0 ? 1.0 : -1.0) - offset);
    tilts += std::acos(std::min(1.0, std::abs(cosine))) * 180.0 / std::numbers::pi;
  }
  EXPECT_LT(heights / kPlanes, 0.15);
  EXPECT_LT(tilts / kPlanes, 4.0);
}

TEST(FacesPlane, IsThatOfTheSideThatFacesTheSameWay) {
  const LabelBox sheet = box_of([](const Vec3& p) { return p[2] > 12 && p[2] < 13 ? 1U : 0U; });
  const auto up = plane_of_faces(sheet, Metric(), kMiddle, {0, 1}, Vec3::UnitZ());
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->height * up->normal[2], 0.0, 1e-12);
  const auto down = plane_of_faces(sheet, Metric(), kMiddle, {0, 1}, -Vec3::UnitZ());
  ASSERT_TRUE(down);
  EXPECT_NEAR(down->height * down->normal[2], 1.0, 1e-12);
}

TEST(FacesPlane, IsMeasuredInTheMetric) {
  const LabelBox half = box_of([](const Vec3& p) { return p[2] > 13 ? 1U : 0U; });
  const auto found = plane_of_faces(half, Metric({1.0, 1.0, 3.0}), kMiddle, {0, 1}, Vec3::UnitZ());
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->height * found->normal[2], 3.0, 1e-12);
}

TEST(FacesPlane, IsNoneWhereFacesMakeNone) {
  const LabelBox half = box_of([](const Vec3& p) { return p[2] > 13 ? 1U : 0U; });
  EXPECT_FALSE(plane_of_faces(half, Metric(), kMiddle, {0, 2}, Vec3::UnitZ()));
  const LabelBox ball = box_of([](const Vec3& p) { return (p - kCentre).norm() < 3.0 ? 1U : 0U; });
  EXPECT_FALSE(plane_of_faces(ball, Metric(), kMiddle, {0, 1}, Vec3::UnitZ()));
  const LabelBox row = box_of(
      [](const Vec3& p) { return p[2] > 12 && p[2] < 13 && p[1] > 12 && p[1] < 13 ? 1U : 0U; });
  EXPECT_FALSE(plane_of_faces(row, Metric(), kMiddle, {0, 1}, Vec3::UnitZ()));
}

}  // namespace
}  // namespace mw::test
