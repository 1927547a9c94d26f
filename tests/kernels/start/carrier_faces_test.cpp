// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which faces can carry the samples of a face, against a walk over points of the faces.
#include "kernels/start/carrier_faces.h"
#include "kernels/core/index.h"
#include "kernels/core/metric.h"
#include "kernels/start/corner_quadric.h"
#include "tests/kernels/start/coarsen/coarse_volume.h"

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

// The quadric of corners of coarsened labels, against explicit planes.

Vec3 real(Index3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// The faces between two labels: centres and normals, from the smaller label to
/// the larger.
struct Sheet {
  std::vector<Vec3> centres;
  Vec3 normals = Vec3::Zero();

  /// Returns the sum of squared distances of x from the planes of all faces.  x, voxel (its edges):
  /// in physical units.
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
