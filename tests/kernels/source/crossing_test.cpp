// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Crossings of scores against the surfaces that scores are distances to; zeros of planes and balls
// that are known at the centres of voxels.
#include "kernels/source/crossing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace mw::test {
namespace {

using Field = std::function<double(const Vec3&)>;

double from_minus_1_to_1(std::mt19937& random) {
  return static_cast<double>(random()) / 2147483647.5 - 1.0;
}

Vec3 any_vector(std::mt19937& random) {
  return {from_minus_1_to_1(random), from_minus_1_to_1(random), from_minus_1_to_1(random)};
}

/// What is known of a field at the ends of a way of length one that begins at `below`.
ScoreDifference known_around(const Field& field, const Vec3& below, unsigned axis) {
  ScoreDifference out;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec3 at = below + static_cast<double>(side) * Vec3::Unit(static_cast<int>(axis));
    out.values[side] = field(at);
    for (int k = 0; k < 3; ++k) {
      out.slopes[side][k] = 0.5 * (field(at + Vec3::Unit(k)) - field(at - Vec3::Unit(k)));
    }
  }
  return out;
}

bool has_crossing(const ScoreDifference& d) {
  return d.values[0] >= 0.0 && d.values[1] <= 0.0 && d.values[0] > d.values[1];
}

/// A crossing of a field above a voxel, and the point where it is; none if the field has none
/// there.
struct FieldCrossing {
  SourcePlane plane;
  Vec3 place;
};
std::optional<FieldCrossing> crossing_of(const Field& field, const Vec3& below, unsigned axis) {
  const ScoreDifference difference = known_around(field, below, axis);
  if (!has_crossing(difference)) return std::nullopt;
  const SourcePlane plane = find_crossing(difference, axis);
  return FieldCrossing{plane, below + (0.5 + plane.height) * Vec3::Unit(static_cast<int>(axis))};
}

TEST(Crossing, OfPlanesIsExact) {
  std::mt19937 random(7);
  int found = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Vec3 normal = any_vector(random).normalized(), below = any_vector(random);
    const double scale = 0.01 + std::abs(from_minus_1_to_1(random));
    const Field field = [&](const Vec3& p) { return -scale * normal.dot(p); };
    const auto found_here = crossing_of(field, below, static_cast<unsigned>(trial % 3));
    if (!found_here) continue;
    EXPECT_NEAR(normal.dot(found_here->place), 0.0, 1e-9);
    EXPECT_NEAR(found_here->plane.normal.dot(normal), 1.0, 1e-9);
    ++found;
  }
  EXPECT_GT(found, 500);
}

TEST(Crossing, OfBallsIsNearerThanAStraightLineCanBe) {
  constexpr double kRadius = 6.0;
  std::mt19937 random(8);
  const Field field = [](const Vec3& p) { return kRadius - p.norm(); };
  double sum = 0.0, squares = 0.0, largest = 0.0;
  int found = 0;
  for (int trial = 0; trial < 300000; ++trial) {
    const Vec3 below = 7.0 * any_vector(random);
    const auto found_here = crossing_of(field, below, static_cast<unsigned>(trial % 3));
    if (!found_here) continue;
    const double off = found_here->place.norm() - kRadius;
    sum += off;
    squares += off * off;
    largest = std::max(largest, std::abs(off));
    EXPECT_GT(found_here->plane.normal.dot(found_here->place.normalized()), std::cos(0.03));
    ++found;
  }
  EXPECT_GT(found, 3000);
  EXPECT_LT(largest, 0.02);  // where the way hardly enters the ball
  EXPECT_LT(std::sqrt(squares / found), 0.0015);
  EXPECT_LT(std::abs(sum / found), 0.0005);
}

TEST(Crossing, IsBetweenTheCentresWhateverTheSlopes) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 2000; ++trial) {
    ScoreDifference d{
        .values = {std::abs(from_minus_1_to_1(random)), -std::abs(from_minus_1_to_1(random))},
        .slopes = {100.0 * any_vector(random), 100.0 * any_vector(random)}};
    const SourcePlane plane = find_crossing(d, 1);
    EXPECT_LE(std::abs(plane.height), kMaxSourceHeight);
    EXPECT_GT(plane.normal[1], 0.0);
    EXPECT_NEAR(plane.normal.norm(), 1.0, 1e-12);
  }
}

TEST(Crossing, IsTheFaceWhereThereIsNone) {
  const double inf = std::numeric_limits<double>::infinity(), nan = inf - inf;
  for (const std::array<double, 2> values :
       {std::array{0.0, 0.0}, std::array{1.0, 0.5}, std::array{-1.0, 1.0}, std::array{inf, -1.0},
        std::array{nan, -1.0}, std::array{1.0, nan}}) {
    const SourcePlane plane = find_crossing({.values = values}, 2);
    EXPECT_EQ(plane.height, 0.0);
    EXPECT_EQ(plane.normal, Vec3::Unit(2));
  }
}

TEST(Crossing, HasAUnitNormalWhereScoresHardlyDiffer) {
  for (int exponent = -320; exponent < -100; ++exponent) {
    const double tiny = std::pow(10.0, exponent);
    const SourcePlane plane = find_crossing(
        {.values = {tiny, -tiny}, .slopes = {Vec3(tiny, -tiny, -tiny), Vec3(0, 0, -tiny)}}, 2);
    EXPECT_NEAR(plane.normal.norm(), 1.0, 1e-12) << exponent;
  }
}

TEST(Crossing, IsSeenFromFacesOfLayers) {
  // Three layers along z.  The plane x = z / 6 in voxels of scores is x = z / 18 in the lattice.
  const Vec3 normal = Vec3(1.0, 0.0, -1.0 / 6.0).normalized();
  const SourcePlane crossing{normal, 0.25};
  for (int layer = -1; layer <= 1; ++layer) {
    const SourcePlane seen =
        on_lattice(crossing, {.axis = 0, .layers = {1, 1, 3}, .centre = Vec3(0.0, 0.0, layer)});
    EXPECT_NEAR(seen.height, 0.25 + layer / 18.0, 1e-12);
    EXPECT_NEAR(seen.normal[2] / seen.normal[0], -1.0 / 18.0, 1e-12);
  }
  const SourcePlane along = on_lattice({Vec3::Unit(2), 0.1}, {.axis = 2, .layers = {1, 1, 3}});
  EXPECT_NEAR(along.height, 0.3, 1e-12);
  const SourcePlane far = on_lattice({Vec3::Unit(2), -0.4}, {.axis = 2, .layers = {1, 1, 3}});
  EXPECT_NEAR(far.height, -1.2, 1e-12);
  const SourcePlane slanted{Vec3(0.1, 0.0, -1.0).normalized(), 0.0};
  const LayeredFace off{.axis = 0, .layers = {1, 1, 3}, .centre = Vec3(0.0, 0.0, 1.0)};
  EXPECT_EQ(on_lattice(slanted, off).height, crossing_form({1, 1, 3}).reach);
}

TEST(Crossing, IsStoredToHalfAUnitOfTheLatticeForEachLayer) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 2000; ++trial) {
    const std::int64_t layers = 1 + trial % 40;
    const PlaneForm form = crossing_form({1, layers, 1});
    const SourcePlane plane{any_vector(random).normalized(),
                            form.reach * from_minus_1_to_1(random)};
    const SourcePlane again = unpack(pack(plane, form), form);
    EXPECT_NEAR(again.height, plane.height, 0.5 / 1024 * static_cast<double>(layers));
    EXPECT_LT((again.normal - plane.normal).norm(), 0.005);
  }
}

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
}  // namespace mw::test
