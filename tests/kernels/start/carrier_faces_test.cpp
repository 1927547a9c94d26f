// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which faces can carry the samples of a face, against a walk over points of the faces.
#include "kernels/start/carrier_faces.h"

#include <gtest/gtest.h>

#include <limits>

#include "kernels/core/index.h"
#include "kernels/core/metric.h"

namespace mw::test {
namespace {

/// Points of the face, `steps` intervals along each side, in voxels.
std::vector<Vec3> points_of(const VoxelFace& face, int steps) {
  std::vector<Vec3> out;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
      Vec3 p(static_cast<double>(face.lower.x), static_cast<double>(face.lower.y),
             static_cast<double>(face.lower.z));
      p += face.axis == 0 ? Vec3(1, u, v) : face.axis == 1 ? Vec3(u, 1, v) : Vec3(u, v, 1);
      out.push_back(p);
    }
  }
  return out;
}

/// Largest distance of the four samples of `from` to the points of `to`.  Samples lie at odd
/// quarters, so points at quarters hold the nearest ones.
double farthest_sample(const VoxelFace& from, const VoxelFace& to) {
  double farthest = 0.0;
  for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
    const Point p = sample_position(face_samples(from.lower, from.axis, kAllQuarters), quarter);
    const Vec3 sample = Vec3(p.x, p.y, p.z) / static_cast<double>(kUnitsPerVoxel);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& x : points_of(to, 4)) nearest = std::min(nearest, (x - sample).norm());
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

bool listed(const std::vector<VoxelFace>& faces, const VoxelFace& face) {
  return std::count(faces.begin(), faces.end(), face) == 1;
}

TEST(CarrierFaces, AreAllThatHoldAPointNearEachSample) {
  // Samples have no negative coordinates.
  const Index3 home{5, 5, 5};
  for (const double bound : {0.3, 0.71, 0.8, 1.0, 1.23, 1.5, 4.0}) {
    const CarrierFaces carriers(bound);
    const double reach = std::max(std::min(bound, kMaxCoarseDistance) - kSampleCoveringRadius, 0.0);
    for (unsigned axis = 0; axis < 3; ++axis) {
      std::size_t expected = 0;
      for_each_index(Box3{{-4, -4, -4}, {5, 5, 5}}, [&](Index3 lower) {
        for (unsigned other = 0; other < 3; ++other) {
          const double d = farthest_sample({home, axis}, {home + lower, other});
          if (d > 0.0) {
            ASSERT_GT(std::abs(d - reach), 1e-9) << "a bound too close to tell";
          }
          if (d > reach) continue;
          ++expected;
          EXPECT_TRUE(listed(carriers.of(axis), {lower, other}));
          EXPECT_TRUE(listed(carriers.carried_by(other), {Index3{0, 0, 0} - lower, axis}));
        }
      });
      EXPECT_EQ(carriers.of(axis).size(), expected);
      EXPECT_EQ(carriers.of(axis).front(), (VoxelFace{{0, 0, 0}, axis}));
      for (std::size_t i = 1; i < expected; ++i) {
        const VoxelFace &a = carriers.of(axis)[i - 1], &b = carriers.of(axis)[i];
        EXPECT_LE(farthest_sample({home, axis}, {home + a.lower, a.axis}),
                  farthest_sample({home, axis}, {home + b.lower, b.axis}) + 1e-12);
      }
    }
  }
}

TEST(CarrierFaces, KnowEachOtherFromBothSides) {
  const CarrierFaces carriers(1.5);
  std::size_t pairs = 0, reverse = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    pairs += carriers.of(axis).size();
    reverse += carriers.carried_by(axis).size();
  }
  EXPECT_EQ(pairs, reverse);
  EXPECT_GT(pairs, 30U);
}

}  // namespace
}  // namespace mw::test
