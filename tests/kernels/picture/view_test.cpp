// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Views, cameras and colours.
#include <Eigen/Geometry>
#include <numbers>

#include "kernels/picture/view.h"
#include "tests/testing.h"

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

// Sections of tets and what a plane leaves of triangles, by area.

using Tet = std::array<Vec3, 4>;

/// Zero of polygons whose corners turn back.
Vec3 area_vector(const Piece& piece) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < piece.count; ++i) {
    sum += (piece.corners[i] - piece.corners[0]).cross(piece.corners[i + 1] - piece.corners[0]) / 2;
  }
  return sum;
}

/// Six tets in each of side^3 cubes of edge 1 / side.
std::vector<Tet> cubes_of_tets(int side) {
  std::vector<Tet> out;
  for (int cube = 0; cube < side * side * side; ++cube) {
    const int x = cube % side, y = cube / side % side, z = cube / side / side;
    const Vec3 lo = Eigen::Vector3i(x, y, z).cast<double>();
    std::array<int, 3> order{0, 1, 2};
    do {
      Tet tet{lo, lo, lo, lo};
      for (std::size_t i = 0; i < 3; ++i) {
        tet[i + 1] = tet[i] + Vec3::Unit(order[i]);
      }
      for (Vec3& corner : tet) corner /= side;
      out.push_back(tet);
    } while (std::next_permutation(order.begin(), order.end()));
  }
  return out;
}

TEST(CrossSection, OfAMeshCoversTheCutOnce) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 60; ++round) {
    Eigen::Matrix3d skew;
    for (int i = 0; i < 9; ++i) skew(i / 3, i % 3) = number(random);
    const Vec3 normal = skew.col(0).cross(skew.col(1));
    // In every other round exactly through corners, if not for rounding.
    const double share = round % 2 == 0 ? 0.5 : (number(random) + 1) / 2;
    const CutPlane plane{.normal = normal, .offset = share * normal.dot(skew.col(2))};
    double area = 0;
    for (Tet tet : cubes_of_tets(2)) {
      for (Vec3& corner : tet) corner = skew * corner;
      std::shuffle(tet.begin(), tet.end(), random);
      area += area_vector(cross_section(tet, plane)).norm();
    }
    EXPECT_NEAR(area / normal.norm(), 1, 1e-9) << round;
  }
}

TEST(CrossSection, ThroughCornersIsCoveredOnce) {
  for (const double share : {0.0, 0.5}) {
    for (int axis = 0; axis < 3; ++axis) {
      double area = 0;
      for (const Tet& tet : cubes_of_tets(2)) {
        area += area_vector(cross_section(tet, {Vec3::Unit(axis), share})).norm();
      }
      EXPECT_NEAR(area, 1, 1e-12) << share << " of axis " << axis;
    }
  }
}

TEST(CrossSection, IsEmptyAwayFromTheTet) {
  const Tet tet = cubes_of_tets(1)[0];
  EXPECT_EQ(cross_section(tet, {Vec3::UnitX(), 2}).count, 0U);
  EXPECT_EQ(cross_section(tet, {Vec3::UnitX(), -1}).count, 0U);
}

TEST(Clipped, BothSidesAreTheTriangle) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto point = [&] { return Vec3{number(random), number(random), number(random)}; };
  int cut = 0;
  for (int round = 0; round < 500; ++round) {
    const std::array<Vec3, 3> triangle{point(), point(), point()};
    const CutPlane plane{point(), number(random) / 2};
    const CutPlane other{-plane.normal, -plane.offset};
    const Piece kept = clipped(triangle, plane), gone = clipped(triangle, other);
    const Vec3 whole = area_vector({{triangle[0], triangle[1], triangle[2], Vec3::Zero()}, 3});
    EXPECT_NEAR((area_vector(kept) + area_vector(gone) - whole).norm(), 0, 1e-12);
    EXPECT_GE(area_vector(kept).dot(whole), 0);
    for (std::size_t i = 0; i < kept.count; ++i) {
      EXPECT_LT(plane.height(kept.corners[i]), 1e-12);
    }
    cut += kept.count > 0 && gone.count > 0;
  }
  EXPECT_GT(cut, 100);
}

}  // namespace
}  // namespace mw::picture
