// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Zeros of planes and balls that are known at the centres of voxels.
#include "kernels/source/cubic_zero.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

namespace mw {
namespace {

/// A function of the place in voxels, sampled at centres.
class Sampled : public CubicField {
 public:
  explicit Sampled(std::function<double(const Vec3&)> function) : function_(std::move(function)) {}

  [[nodiscard]] CubicValues values_from(Index3 first) const override {
    CubicValues out;
    std::size_t next = 0;
    for_each_index(Box3{first, first + Index3{4, 4, 4}}, [&](Index3 v) {
      out[next++] = function_(Vec3(static_cast<double>(v.x) + 0.5, static_cast<double>(v.y) + 0.5,
                                   static_cast<double>(v.z) + 0.5));
    });
    return out;
  }

 private:
  std::function<double(const Vec3&)> function_;
};

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  Vec3 vector(double most) {
    std::uniform_real_distribution<double> draw(-most, most);
    const double x = draw(random_), y = draw(random_), z = draw(random_);
    return {x, y, z};
  }

 private:
  std::mt19937 random_;
};

TEST(CubicZero, IsTheFootOnAPlane) {
  Draw draw(371);
  for (int round = 0; round < 200; ++round) {
    const Vec3 voxel = Vec3(1, 1, 1) + draw.vector(0.7), through = draw.vector(5);
    // The plane's normal in the world; a step of one voxel is `voxel` long there.
    const Vec3 normal = draw.vector(1).normalized();
    const Sampled plane(
        [&](const Vec3& at) { return 3.0 * normal.dot((at - through).cwiseProduct(voxel)); });
    const Vec3 near = through + draw.vector(0.8);
    const double height = normal.dot((near - through).cwiseProduct(voxel));
    const Vec3 foot = near - (height * normal).cwiseQuotient(voxel);
    const std::optional<Vec3> found = find_zero(plane, near, voxel, 10.0);
    ASSERT_TRUE(found);
    EXPECT_LT((*found - foot).norm(), 1e-9);
  }
}

TEST(CubicZero, IsOnABall) {
  Draw draw(372);
  for (int round = 0; round < 200; ++round) {
    const Vec3 centre = draw.vector(3);
    const double radius = 5.0 + 0.05 * round;
    const Sampled ball([&](const Vec3& at) { return (at - centre).norm() - radius; });
    const Vec3 near = centre + draw.vector(1).normalized() * (radius + draw.vector(0.9)[0]);
    const std::optional<Vec3> found = find_zero(ball, near, {1, 1, 1}, 1.5);
    ASSERT_TRUE(found);
    EXPECT_NEAR((*found - centre).norm(), radius, 2e-3);
    // It is nearly the nearest point.
    EXPECT_LT((*found - near).norm(), std::abs((near - centre).norm() - radius) + 0.01);
  }
}

TEST(CubicZero, IsNowhereWithoutOne) {
  const Vec3 voxel(1, 1, 1), near(0.3, 0.4, 0.7);
  EXPECT_FALSE(find_zero(Sampled([](const Vec3&) { return 1.0; }), near, voxel, 1.5));
  EXPECT_FALSE(find_zero(Sampled([](const Vec3& at) { return at[0] - 4; }), near, voxel, 1.5));
  EXPECT_FALSE(
      find_zero(Sampled([](const Vec3& at) { return at.squaredNorm() + 1; }), near, voxel, 1.5));
  for (const double wrong :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(find_zero(Sampled([&](const Vec3& at) { return at[0] < 0 ? -wrong : wrong; }),
                           near, voxel, 1.5));
  }
}

TEST(CubicZero, SlopesAreThoseOfDifferences) {
  Draw draw(373);
  CubicValues values;
  for (double& value : values) value = draw.vector(1)[0];
  for (int round = 0; round < 50; ++round) {
    const Vec3 at = Vec3(0.5, 0.5, 0.5) + draw.vector(0.45);
    const ValueAndSlope here = interpolate(values, at);
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = 1e-5 * Vec3::Unit(k);
      const double rise =
          interpolate(values, at + step).value - interpolate(values, at - step).value;
      EXPECT_NEAR(here.slope[k], rise / 2e-5, 1e-7);
    }
  }
}

}  // namespace
}  // namespace mw
