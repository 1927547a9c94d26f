// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Area and bends of interfaces: known bodies, and random ones against the definition.
#include <Eigen/Geometry>
#include <numbers>

#include "kernels/audit/audit.h"
#include "kernels/audit/shape/length_bins.h"
#include "kernels/audit/shape/quality.h"
#include "kernels/audit/shape/shape.h"
#include "kernels/audit/shape/volumes.h"
#include "kernels/core/error.h"
#include "kernels/core/index.h"
#include "kernels/core/lattice.h"
#include "tests/oracle/interface_bends.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_audit.h"
#include "tests/testing.h"

namespace mw::audit {
namespace {

using namespace test;

/// Vertices off the lattice of voxel corners by up to a tenth, those on the box too.
void shake(SmallMesh& mesh, std::mt19937& random) {
  for (Position& p : mesh.vertices) {
    for (double& x : p) x += (static_cast<double>(test::below(random, 2001)) - 1000) / 1e4;
  }
}

TEST(Shape, OfRandomMeshesIsThatOfTheDefinition) {
  std::mt19937 random(811);
  std::size_t bends = 0;
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const SmallVolume volume = random_volume(random);
    SmallMesh mesh = five_tet_mesh(volume, {{1, 1, 1.0 + i % 3}, {-5, 7, 0}});
    if (i % 4 != 0) shake(mesh, random);
    if (i % 5 == 0) {
      for (TetRow& tet : mesh.tets) std::swap(tet[0], tet[3]);  // negative, as some tools write
    }
    const InterfaceBends expected = test::interface_bends(mesh.view());
    const ShapeReport actual = measure_shape(mesh.view());
    EXPECT_EQ(actual.triangles, expected.triangles);
    EXPECT_NEAR(actual.area, expected.area, 1e-9 * expected.area);
    // Edges at the very bound of a bin or a share may fall on either side of it.
    EXPECT_NEAR(actual.bend_max_deg, expected.percentile(1), 1e-5);
    EXPECT_NEAR(actual.sharp_share, expected.share_above(kSharpDegrees), 1e-9) << volume.text();
    for (const auto& [share, found] : {std::pair{0.5, actual.bend_p50_deg},
                                       {0.95, actual.bend_p95_deg},
                                       {0.99, actual.bend_p99_deg}}) {
      EXPECT_GE(found, expected.percentile(share - 1e-9) - 0.0501);
      EXPECT_LE(found, expected.percentile(share + 1e-9) + 0.0501);
    }
    double beyond = 1;
    for (int bin = 0; bin + 1 < 36 && i % 4 != 0 && !expected.bends.empty(); ++bin) {
      beyond -= actual.bend_histogram[static_cast<std::size_t>(bin)];
      EXPECT_NEAR(beyond, expected.share_above(5.0 * (bin + 1)), 1e-9) << bin;
    }
    bends += expected.bends.size();
  }
  EXPECT_GT(bends, 1000U);
}

TEST(Shape, OfAPlaneIsFlat) {
  const SmallVolume halves = volume_from({4, 6, 5}, 2, [](auto x, auto, auto) { return x / 2; });
  const ShapeReport shape = measure_shape(five_tet_mesh(halves, {{1, 2, 3}, {0, 0, 0}}).view());
  EXPECT_EQ(shape.triangles, 60U);
  EXPECT_DOUBLE_EQ(shape.area, 6 * 2 * 5 * 3.0);
  EXPECT_LT(shape.bend_max_deg, 1e-9);
  EXPECT_EQ(shape.sharp_share, 0);
}

/// A cube of 2^3 voxels: 24 edges of one voxel bend by 90 degrees, and 24 of them and 24 diagonals
/// by nothing.
TEST(Shape, OfACubeHasRightAngles) {
  const SmallVolume cube = volume_from({4, 4, 4}, 2, [](auto x, auto y, auto z) {
    const auto inside = [](auto v) { return v == 1 || v == 2; };
    return inside(x) && inside(y) && inside(z) ? 1 : 0;
  });
  SmallMesh mesh = five_tet_mesh(cube);
  for (int turned = 0; turned < 2; ++turned) {
    const ShapeReport shape = measure_shape(mesh.view());
    EXPECT_EQ(shape.triangles, 48U);
    EXPECT_DOUBLE_EQ(shape.area, 24);
    EXPECT_DOUBLE_EQ(shape.bend_max_deg, 90);
    EXPECT_NEAR(shape.bend_p95_deg, 90, 0.05);
    EXPECT_NEAR(shape.bend_p50_deg, 0, 0.05);
    EXPECT_NEAR(shape.sharp_share, 24 / (48 + 24 * std::sqrt(2)), 1e-12);
    EXPECT_NEAR(shape.bend_histogram[18], shape.sharp_share, 1e-12);
    EXPECT_NEAR(shape.bend_histogram[0], 1 - shape.sharp_share, 1e-12);
    for (Label& l : mesh.labels) l = 1 - l;
  }
}

/// Where three labels meet nothing bends, and where two interfaces touch in an edge neither does.
TEST(Shape, LeavesOutEdgesOfSeveralInterfaces) {
  const SmallVolume corner = volume_from(
      {2, 2, 1}, 3, [](auto x, auto y, auto) { return x == 0 ? 0 : static_cast<int>(1 + y); });
  EXPECT_EQ(measure_shape(five_tet_mesh(corner).view()).bend_max_deg, 0);
  const SmallVolume board =
      volume_from({2, 2, 1}, 2, [](auto x, auto y, auto) { return (x + y) % 2; });
  EXPECT_EQ(measure_shape(five_tet_mesh(board).view()).bend_max_deg, 0);
}

TEST(Shape, OfOneLabelIsNothing) {
  const SmallVolume one = volume_from({2, 2, 2}, 1, [](auto, auto, auto) { return 0; });
  const ShapeReport shape = measure_shape(five_tet_mesh(one).view());
  EXPECT_EQ(shape.triangles, 0U);
  EXPECT_EQ(shape.area, 0);
  EXPECT_EQ(shape.sharp_share, 0);
}

// P3: radius ratios and dihedral angles of tets whose shape is known.

SmallVolume box(Index3 shape) {
  return volume_from(shape, 1, [](auto, auto, auto) { return 0; });
}

TEST(Quality, RegularTetHasRadiusRatioOne) {
  EXPECT_NEAR(radius_ratio({1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}), 1, 1e-15);
  EXPECT_NEAR(radius_ratio({1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}), 1, 1e-15);
}

TEST(Quality, FlatTetHasRadiusRatioZero) {
  EXPECT_EQ(radius_ratio({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}), 0);
  EXPECT_EQ(radius_ratio({0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}), 0);
}

TEST(Quality, CornerTetOfACube) {
  // r_in = 1 / (3 + sqrt 3), r_circ = sqrt(3) / 2, any scale.
  const double expected = 3 / (3 + std::sqrt(3.0)) / (std::sqrt(3.0) / 2);
  EXPECT_NEAR(radius_ratio({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), expected, 1e-15);
  EXPECT_NEAR(radius_ratio({7, 7, 7}, {10, 7, 7}, {7, 10, 7}, {7, 7, 10}), expected, 1e-15);
}

TEST(Quality, FiveTetMeshOfCubes) {
  const SmallMesh mesh = five_tet_mesh(box({2, 3, 4}));
  const QualityReport report = measure_quality(mesh.view());
  EXPECT_NEAR(report.radius_ratio_min, 0.7320508, 1e-6);
  EXPECT_NEAR(report.radius_ratio_mean, (4 * 0.7320508 + 1) / 5, 1e-6);
  EXPECT_EQ(report.sliver_fraction, 0);
  EXPECT_NEAR(report.dihedral_min_deg, 54.7356103, 1e-6);
  EXPECT_NEAR(report.dihedral_max_deg, 90, 1e-9);
  const auto& bins = report.radius_ratio_histogram;
  EXPECT_EQ(std::accumulate(bins.begin(), bins.end(), std::uint64_t{0}), mesh.tets.size());
  EXPECT_EQ(bins[14], mesh.tets.size() / 5 * 4);
  EXPECT_EQ(bins[19], mesh.tets.size() / 5);
  // Corner tets have three right angles and three of 54.7 degrees, the regular one six of 70.5.
  const std::uint64_t cubes = mesh.tets.size() / 5;
  EXPECT_EQ(report.dihedral_histogram[18], cubes * 12);
  EXPECT_EQ(report.dihedral_histogram[10], cubes * 12);
  EXPECT_EQ(report.dihedral_histogram[14], cubes * 6);
}

TEST(Quality, DihedralHistogramIsThatOfTheAngles) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  std::array<std::uint64_t, 36> expected{};
  QualityMeter meter;
  for (int round = 0; round < 500; ++round) {
    std::array<Eigen::Vector3d, 4> p;
    for (Eigen::Vector3d& corner : p) corner = {number(random), number(random), number(random)};
    const auto position = [&](std::size_t i) { return Position{p[i][0], p[i][1], p[i][2]}; };
    meter.add(position(0), position(1), position(2), position(3));
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) {
        // Along the edge i k the other two corners are seen under the dihedral angle.
        const std::size_t m = i == 0 ? (k == 1 ? 2 : 1) : 0, n = 6 - i - k - m;
        const Eigen::Vector3d edge = (p[k] - p[i]).normalized();
        const auto across = [&](std::size_t at) -> Eigen::Vector3d {
          return p[at] - p[i] - edge * edge.dot(p[at] - p[i]);
        };
        const double angle = std::acos(across(m).normalized().dot(across(n).normalized()));
        ++expected[static_cast<std::size_t>(angle * 180 / std::numbers::pi / 5)];
      }
    }
  }
  EXPECT_EQ(meter.report().dihedral_histogram, expected);
}

TEST(Quality, LengthsAreThoseOfAllTets) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  double shortest = 9, longest = 0, least = 9;
  QualityMeter whole, parts[2];
  for (int round = 0; round < 500; ++round) {
    std::array<Eigen::Vector3d, 4> p;
    for (Eigen::Vector3d& corner : p) corner = {number(random), number(random), number(random)};
    const auto position = [&](std::size_t i) { return Position{p[i][0], p[i][1], p[i][2]}; };
    whole.add(position(0), position(1), position(2), position(3));
    parts[round % 2].add(position(0), position(1), position(2), position(3));
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d &a = p[(i + 1) % 4], &b = p[(i + 2) % 4], &c = p[(i + 3) % 4];
      shortest = std::min(shortest, (p[i] - a).norm());
      longest = std::max(longest, (p[i] - a).norm());
      least = std::min(least, std::abs((p[i] - a).dot((b - a).cross(c - a).normalized())));
      for (const Eigen::Vector3d& other : {b, c}) {
        shortest = std::min(shortest, (p[i] - other).norm());
        longest = std::max(longest, (p[i] - other).norm());
      }
    }
  }
  parts[0].add(parts[1]);
  for (const QualityReport& report : {whole.report(), parts[0].report()}) {
    EXPECT_NEAR(report.edge_min, shortest, 1e-12);
    EXPECT_NEAR(report.edge_max, longest, 1e-12);
    EXPECT_NEAR(report.height_min, least, 1e-12);
  }
}

TEST(Quality, OfSeveralTetsAtOnceIsThatOfEach) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  for (std::size_t count = 0; count < 40; ++count) {
    std::vector<NumberedTet> tets(count);
    QualityMeter singly, at_once;
    for (NumberedTet& tet : tets) {
      tet.number = random() % 100;
      for (Position& corner : tet.corners) corner = {number(random), number(random), 0.0};
      // Some tets are flat, and of some flat ones two corners are one.
      if (random() % 4 != 0) tet.corners[3][2] = number(random);
      if (random() % 8 == 0) tet.corners[1] = tet.corners[0];
      singly.add({&tet, 1});
    }
    at_once.add(tets);
    const QualityReport expected = singly.report(), report = at_once.report();
    EXPECT_EQ(report.radius_ratio_min, expected.radius_ratio_min);
    EXPECT_EQ(report.worst_tet, expected.worst_tet);
    EXPECT_EQ(report.radius_ratio_mean, expected.radius_ratio_mean);
    EXPECT_EQ(report.radius_ratio_histogram, expected.radius_ratio_histogram);
    EXPECT_EQ(report.dihedral_histogram, expected.dihedral_histogram);
    EXPECT_EQ(report.sliver_fraction, expected.sliver_fraction);
    EXPECT_EQ(report.dihedral_min_deg, expected.dihedral_min_deg);
    EXPECT_EQ(report.dihedral_max_deg, expected.dihedral_max_deg);
    EXPECT_EQ(report.edge_min, expected.edge_min);
    EXPECT_EQ(report.edge_max, expected.edge_max);
    EXPECT_EQ(report.edge_median, expected.edge_median);
    EXPECT_EQ(report.height_min, expected.height_min);
  }
}

TEST(LengthBins, GiveTheMedianOfAllParts) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> power(-90, 90);
  for (const std::size_t count : {1U, 2U, 7U, 1000U}) {
    std::vector<double> lengths;
    LengthBins whole, parts[2];
    for (std::size_t i = 0; i < count; ++i) {
      lengths.push_back(std::pow(2.0, power(random)));
      whole.add(lengths.back());
      parts[i % 2].add(lengths.back());
    }
    std::ranges::sort(lengths);
    parts[1].add(parts[0]);
    EXPECT_NEAR(whole.median() / lengths[(count - 1) / 2], 1, 1e-3);
    EXPECT_EQ(parts[1].median(), whole.median());
  }
  LengthBins ends;
  EXPECT_EQ(ends.median(), 0);
  ends.add(std::numeric_limits<double>::infinity());
  EXPECT_EQ(ends.median(), std::numeric_limits<double>::infinity());
  ends.add(0);
  EXPECT_EQ(ends.median(), 0);
}

TEST(Quality, IsMeasuredInPhysicalUnits) {
  const Frame thin{{1, 1, 100}, {0, 0, 0}};
  const QualityReport report = measure_quality(five_tet_mesh(box({1, 1, 1}), thin).view());
  EXPECT_LT(report.radius_ratio_min, kSliverRadiusRatio);
  EXPECT_GT(report.sliver_fraction, 0.5);
}

TEST(Quality, NamesTheWorstTet) {
  const std::vector<Position> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {.3, .3, 1e-6}};
  const std::vector<TetRow> tets{{0, 1, 2, 3}, {0, 1, 2, 4}, {1, 2, 3, 4}};
  const QualityReport report = measure_quality({vertices, tets, {}});
  EXPECT_EQ(report.worst_tet, 1U);
  EXPECT_LT(report.radius_ratio_min, 1e-5);
  EXPECT_LT(report.dihedral_min_deg, 1e-3);
  EXPECT_GT(report.dihedral_max_deg, 179.99);
}

TEST(Quality, EmptyMeshIsZeros) {
  EXPECT_EQ(measure_quality({}).radius_ratio_min, 0);
  EXPECT_EQ(measure_quality({}).dihedral_max_deg, 0);
  EXPECT_EQ(measure_quality({}).edge_min, 0);
  EXPECT_EQ(measure_quality({}).height_min, 0);
}

// The layered input: the same solid, measured in finer voxels.

TEST(LayeredLabels, RepeatEachVoxel) {
  std::mt19937 random(731);
  for (int i = 0; i < 100; ++i) {
    const SmallVolume volume = random_volume(random);
    const Index3 layers{1 + below(random, 4), 1 + below(random, 4), 1 + below(random, 4)};
    const LayeredLabels layered = layered_labels(volume.view(), layers);
    EXPECT_EQ(layered.shape, layered_shape(volume.shape, layers));
    const Box3 all{{0, 0, 0}, volume.shape};
    std::size_t next = 0;
    for_each_index(layered.shape, [&](Index3 v) {
      const Index3 voxel{v.x / layers.x, v.y / layers.y, v.z / layers.z};
      ASSERT_EQ(layered.labels[next++], volume.labels[static_cast<std::size_t>(all.offset(voxel))]);
    });
    EXPECT_EQ(layered.labels.size(), next);
  }
}

TEST(LayeredLabels, RefuseWhatIsTooLong) {
  const std::vector<Label> one{0};
  EXPECT_THROW((void)layered_labels({.shape = {1, 1, 1}, .labels = one}, {1, 1, (1 << 20) + 1}),
               Error);
}

/// A mesh that is off by one voxel of a thick slice is off by all its layers.
TEST(Promise4Distance, CountsInLayersAsAsked) {
  const SmallVolume volume =
      test::volume_from({4, 4, 4}, 2, [](auto, auto, auto z) { return z / 2; });
  const SmallVolume other =
      test::volume_from({4, 4, 4}, 2, [](auto, auto, auto z) { return z == 3 ? 1 : 0; });
  const auto mesh = five_tet_mesh(other);
  const auto farthest = [&](Index3 layers) {
    return audit(volume.view(), 2, mesh.view(), {}, {.layers = layers}).distance->max_voxels;
  };
  EXPECT_DOUBLE_EQ(farthest({1, 1, 1}), 1.0);
  EXPECT_DOUBLE_EQ(farthest({1, 1, 5}), 5.0);
  EXPECT_DOUBLE_EQ(farthest({3, 3, 1}), 1.0);
}

}  // namespace
}  // namespace mw::audit
