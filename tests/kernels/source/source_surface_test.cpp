// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Source surfaces against the shapes that voxels were sampled from.
#include "kernels/source/source_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "kernels/start/cells/cell.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

/// A face between two labels, its centre, and the plane that is found for it; in voxels.
struct FoundFace {
  Index3 lower;
  unsigned axis = 0;
  LabelPair labels;
  double sign = 1.0;  ///< 1 where the smaller label is on the lower side
  Vec3 centre;
  SourcePlane plane;

  [[nodiscard]] Vec3 place() const { return centre + plane.height * plane.normal; }
};

SourceSurface surface_of(const SmallVolume& volume, const Box3& box) {
  return {labels_in(volume, grown(box, kSourceHalo)), box};
}

std::vector<FoundFace> faces_of(const SmallVolume& volume) {
  const Box3 all{{0, 0, 0}, volume.shape};
  const SourceSurface surface = surface_of(volume, all);
  const LabelBox labels = labels_in(volume, grown(all, 1));
  std::vector<FoundFace> out;
  for_each_index(all, [&](Index3 v) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const Label below = labels.at(v), above = labels.at(v + axis_vector(axis));
      if (below == above || above == kExterior) continue;
      Vec3 centre(static_cast<double>(v.x) + 0.5, static_cast<double>(v.y) + 0.5,
                  static_cast<double>(v.z) + 0.5);
      centre[static_cast<int>(axis)] += 0.5;
      out.push_back({v, axis, label_pair(below, above), below < above ? 1.0 : -1.0, centre,
                     unpack(surface.at(v, axis))});
    }
  });
  return out;
}

/// Labels of the points p, in voxels from the middle of a cube, that voxels have their centres at.
template <typename LabelOf>
SmallVolume sampled(std::int64_t edge, std::size_t labels, LabelOf label_of) {
  const double half = 0.5 * static_cast<double>(edge);
  const auto from_middle = [half](std::int64_t v) { return static_cast<double>(v) + 0.5 - half; };
  return volume_from({edge, edge, edge}, labels,
                     [&](std::int64_t x, std::int64_t y, std::int64_t z) -> Label {
                       return label_of(Vec3(from_middle(x), from_middle(y), from_middle(z)));
                     });
}

double uniform(std::mt19937& random) {
  return below(random, 1U << 20U) / static_cast<double>(1U << 20U);
}

Vec3 random_direction(std::mt19937& random) {
  for (;;) {
    const Vec3 v(2.0 * uniform(random) - 1.0, 2.0 * uniform(random) - 1.0,
                 2.0 * uniform(random) - 1.0);
    if (v.norm() < 1.0 && v.norm() > 0.1) return v.normalized();
  }
}

double degrees(double radians) {
  return 180.0 / std::numbers::pi * radians;
}

double root_mean(double sum, std::size_t count) {
  return std::sqrt(sum / static_cast<double>(count));
}

TEST(SourcePlane, PacksWithinItsSteps) {
  std::mt19937 random(71);
  for (int i = 0; i < 1000; ++i) {
    const SourcePlane plane{random_direction(random), uniform(random) - 0.5};
    const SourcePlane back = unpack(pack(plane));
    EXPECT_NEAR(back.height, plane.height, 0.5 / 254.0 + 1e-12);
    EXPECT_LT((back.normal - plane.normal).norm(), 1.5e-3);
    EXPECT_NEAR(back.normal.norm(), 1.0, 1e-12);
    EXPECT_EQ(pack(back), pack(plane));
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 normal = sign * Vec3::Unit(axis);
      const SourcePlane back = unpack(pack({normal, 0.0}));
      EXPECT_EQ(back.normal, normal);
      EXPECT_EQ(back.height, 0.0);
    }
  }
}

TEST(SourceSurface, LiesOnTiltedPlanes) {
  constexpr std::int64_t kEdge = 40;
  constexpr double kMargin = 9.0;
  std::mt19937 random(72);
  double heights = 0.0, angles = 0.0, largest = 0.0;
  std::size_t count = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Vec3 normal = random_direction(random);
    const double offset = 2.0 * uniform(random) - 1.0;
    const SmallVolume volume = sampled(
        kEdge, 2, [&](const Vec3& p) { return normal.dot(p) < offset ? Label{0} : Label{1}; });
    for (const FoundFace& f : faces_of(volume)) {
      const Vec3 from_middle = f.place() - Vec3::Constant(0.5 * kEdge);
      if (from_middle.cwiseAbs().maxCoeff() > 0.5 * kEdge - kMargin) continue;
      const double height = normal.dot(from_middle) - offset;
      const double cosine = std::min(1.0, f.sign * f.plane.normal.dot(normal));
      heights += height * height;
      angles += std::pow(degrees(std::acos(cosine)), 2);
      largest = std::max(largest, std::abs(height));
      ++count;
    }
  }
  ASSERT_GT(count, 1000U);
  EXPECT_LT(root_mean(heights, count), 0.08);
  EXPECT_LT(root_mean(angles, count), 1.6);
  EXPECT_LT(largest, 0.3);
}

TEST(SourceSurface, LiesOnBallsOfAnyRadius) {
  std::mt19937 random(73);
  for (const double radius : {4.0, 6.0, 9.0, 14.0, 20.0}) {
    const Vec3 centre(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
    const std::int64_t edge = 2 * static_cast<std::int64_t>(radius) + 6;
    const SmallVolume volume = sampled(
        edge, 2, [&](const Vec3& p) { return (p - centre).norm() < radius ? Label{1} : Label{0}; });
    double sum = 0.0, squares = 0.0;
    const std::vector<FoundFace> faces = faces_of(volume);
    for (const FoundFace& f : faces) {
      const Vec3 from_centre = f.place() - Vec3::Constant(0.5 * static_cast<double>(edge)) - centre;
      const double height = from_centre.norm() - radius;
      sum += height;
      squares += height * height;
      EXPECT_LT(f.sign * f.plane.normal.dot(from_centre), 0.0);
    }
    const auto count = static_cast<double>(faces.size());
    EXPECT_LT(std::abs(sum / count), 0.06) << radius;
    EXPECT_LT(root_mean(squares, faces.size()), 0.12) << radius;
  }
}

/// A cube of 20 voxels, turned: away from its edges faces lie on its sides, normals are theirs.
TEST(SourceSurface, KeepsEdgesSharp) {
  constexpr std::int64_t kEdge = 44;
  constexpr double kHalf = 10.0;
  std::mt19937 random(76);
  double heights = 0.0, angles = 0.0;
  std::size_t count = 0;
  for (int trial = 0; trial < 4; ++trial) {
    Eigen::Matrix3d turn;
    turn.row(0) = random_direction(random);
    turn.row(1) = turn.row(0).cross(random_direction(random)).normalized();
    turn.row(2) = turn.row(0).cross(turn.row(1));
    const SmallVolume volume = sampled(kEdge, 2, [&](const Vec3& p) {
      return (turn * p).lpNorm<Eigen::Infinity>() < kHalf ? Label{0} : Label{1};
    });
    for (const FoundFace& f : faces_of(volume)) {
      const Vec3 p = turn * (f.place() - Vec3::Constant(0.5 * kEdge));
      Eigen::Index side = 0;
      const double height = p.cwiseAbs().maxCoeff(&side) - kHalf;
      Vec3 along = p.cwiseAbs();
      along[side] = 0.0;
      if (along.maxCoeff() > kHalf - 2.0) continue;
      const double cosine = std::abs((turn * f.plane.normal)[side]);
      heights += height * height;
      angles += std::pow(degrees(std::acos(std::min(1.0, cosine))), 2);
      ++count;
    }
  }
  ASSERT_GT(count, 1000U);
  EXPECT_LT(root_mean(heights, count), 0.08);
  EXPECT_LT(root_mean(angles, count), 4.0);
}

/// Flat layers of any thickness, across any axis, of which labels come again: all as they are.
TEST(SourceSurface, IsExactOnLayersAlongAxes) {
  const std::array<std::int64_t, 6> starts{3, 4, 6, 7, 12, 13};
  for (unsigned axis = 0; axis < 3; ++axis) {
    const SmallVolume volume =
        volume_from({16, 16, 16}, 3, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
          const std::int64_t at = axis == 0 ? x : axis == 1 ? y : z;
          return std::count_if(starts.begin(), starts.end(),
                               [at](std::int64_t s) { return s <= at; }) %
                 3;
        });
    const std::vector<FoundFace> faces = faces_of(volume);
    EXPECT_EQ(faces.size(), starts.size() * 256U);
    for (const FoundFace& f : faces) {
      EXPECT_EQ(f.plane.height, 0.0);
      EXPECT_EQ(f.plane.normal, Vec3(Vec3::Unit(static_cast<int>(f.axis))));
    }
  }
}

/// A third label on one side cuts a plane in two, and shifts neither part; a sheet of two voxels
/// keeps its thickness.
TEST(SourceSurface, KeepsPlanesUpToTripleLinesAndSheets) {
  constexpr std::int64_t kEdge = 40;
  const Vec3 normal = Vec3(0.2, 0.3, 0.9).normalized(), across = Vec3(0.9, -0.4, 0.1).normalized();
  const SmallVolume junction = sampled(kEdge, 3, [&](const Vec3& p) {
    if (normal.dot(p) < 0.3) return Label{0};
    return across.dot(p) < 0.1 ? Label{1} : Label{2};
  });
  const SmallVolume sheet = sampled(
      kEdge, 2, [&](const Vec3& p) { return std::abs(normal.dot(p)) < 1.0 ? Label{1} : Label{0}; });
  double squares = 0.0, sheet_squares = 0.0;
  std::size_t count = 0, sheet_count = 0;
  const auto inside = [](const Vec3& p) { return p.cwiseAbs().maxCoeff() < 0.5 * kEdge - 8.0; };
  for (const FoundFace& f : faces_of(junction)) {
    const Vec3 p = f.place() - Vec3::Constant(0.5 * kEdge);
    if (f.labels.low != 0 || !inside(p)) continue;
    squares += std::pow(normal.dot(p) - 0.3, 2);
    ++count;
  }
  for (const FoundFace& f : faces_of(sheet)) {
    const Vec3 p = f.place() - Vec3::Constant(0.5 * kEdge);
    if (!inside(p)) continue;
    sheet_squares += std::pow(std::abs(normal.dot(p)) - 1.0, 2);
    ++sheet_count;
  }
  ASSERT_GT(count, 100U);
  ASSERT_GT(sheet_count, 100U);
  EXPECT_LT(root_mean(squares, count), 0.11);
  EXPECT_LT(root_mean(sheet_squares, sheet_count), 0.11);
}

TEST(SourceSurface, StaysWithinHalfAVoxelOfFacesOfAnything) {
  std::mt19937 random(74);
  for (std::uint32_t kind = 0; kind < audit::test::kVolumeKinds; ++kind) {
    const SmallVolume volume =
        random_volume_of(random, static_cast<VolumeKind>(kind), {9, 8, 7}, 4);
    for (const FoundFace& f : faces_of(volume)) {
      EXPECT_LE(std::abs(f.plane.height), kMaxSourceHeight);
      EXPECT_NEAR(f.plane.normal.norm(), 1.0, 1e-12);
    }
  }
}

/// What is found in a part with its halo is what is found in the whole, and what parts are put
/// together to.
TEST(SourceSurface, IsALocalFunctionOfLabels) {
  std::mt19937 random(75);
  for (const VolumeKind kind : {VolumeKind::kNoise, VolumeKind::kBlobs, VolumeKind::kSheets}) {
    const SmallVolume volume = random_volume_of(random, kind, {44, 40, 37}, 3);
    const Box3 all{{0, 0, 0}, volume.shape}, low{{0, 0, 0}, {17, 40, 37}},
        high{{17, 0, 0}, volume.shape}, some{{9, 3, 5}, {30, 33, 31}};
    const SourceSurface whole = surface_of(volume, all);
    const SourceSurface joined(some, [&](auto visit) {
      for (const Box3& half : {low, high}) visit(surface_of(volume, half).part(half));
    });
    const SourceSurface cut = surface_of(volume, some);
    EXPECT_EQ(joined.part(some).faces, whole.part(some).faces);
    EXPECT_EQ(joined.part(some).planes, whole.part(some).planes);
    EXPECT_EQ(cut.part(some).planes, whole.part(some).planes);
    EXPECT_GT(cut.part(some).planes.size(), 100U);
  }
}

}  // namespace
}  // namespace mw::test
