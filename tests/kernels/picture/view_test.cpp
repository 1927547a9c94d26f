// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Views, cameras and colours.
#include "kernels/picture/view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace mw::picture {
namespace {

TEST(View, IsTheOneOfTheAngles) {
  for (int azimuth = -720; azimuth <= 720; azimuth += 7) {
    for (int elevation = -90; elevation <= 90; elevation += 9) {
      const View view = view_from(azimuth, elevation);
      const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
      const Vec3 viewer{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
      EXPECT_LT((view.viewer - viewer).norm(), 1e-14) << azimuth << ", " << elevation;
      EXPECT_LT((view.right.cross(view.up) - view.viewer).norm(), 1e-14);
      EXPECT_LT(std::abs(view.right[2]), 1e-14);
      EXPECT_GE(view.up[2], -1e-14);
    }
  }
}

TEST(View, FromAboveHasXToTheRightAndYUp) {
  const View view = view_from(-90, 90);
  EXPECT_LT((view.right - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((view.up - Vec3::UnitY()).norm(), 1e-15);
}

TEST(Camera, PutsTheExtentIntoThePicture) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1e4, 1e4);
  for (int round = 0; round < 100; ++round) {
    const View view = view_from(number(random), number(random) / 1e4 * 90);
    std::vector<Vec3> points;
    Extent extent;
    for (int i = 0; i < 20; ++i) {
      points.push_back({number(random) + 1e6, number(random), number(random)});
      extent.add(view, points.back());
    }
    const Camera camera(view, extent, 300, 200);
    double min = 1e9;
    for (const Vec3& point : points) {
      const ScreenPoint seen = camera.at(point);
      EXPECT_GE(seen.depth, 0);
      EXPECT_LE(seen.depth, 1);
      min = std::min({min, seen.x, seen.y, 300 - seen.x, 200 - seen.y});
    }
    EXPECT_NEAR(min, 8, 1e-6);  // 4 % of 200
  }
}

TEST(Camera, NearerPointsHaveLessDepth) {
  const View view = view_from(30, 20);
  Extent extent;
  extent.add(view, view.viewer);
  extent.add(view, -view.viewer + view.right);
  const Camera camera(view, extent, 64, 64);
  EXPECT_LT(camera.at(view.viewer).depth, camera.at(Vec3::Zero()).depth);
}

TEST(Palette, FirstLabelsDiffer) {
  std::set<Colour> seen;
  for (RawLabel label = 0; label < 16; ++label) seen.insert(palette_colour(label));
  EXPECT_EQ(seen.size(), 16U);
}

TEST(Lit, FacesTowardsTheLightAreBrighter) {
  const View view = view_from(0, 0);
  const Colour colour{100, 200, 50};
  const Colour front = lit(colour, view.viewer, view), away = lit(colour, -view.viewer, view);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_GT(front[k], away[k]);
  EXPECT_EQ(lit(colour, Vec3::Zero(), view), colour);
  EXPECT_EQ(lit(colour, 1e9 * view.viewer, view), front);
}

}  // namespace
}  // namespace mw::picture
