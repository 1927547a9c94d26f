// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// P3: radius ratios and dihedral angles of tets whose shape is known.
#include "kernels/audit/shape/quality.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "tests/oracle/small_volumes.h"

namespace mw::audit {
namespace {

using test::five_tet_mesh;
using test::SmallMesh;
using test::SmallVolume;
using test::volume_from;

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
}

}  // namespace
}  // namespace mw::audit
