// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 8: volumes of labels, exact on the lattice, and the check that judges them.
#include "kernels/audit/shape/volumes.h"

#include "kernels/audit/audit.h"
#include "kernels/core/index.h"
#include "kernels/core/lattice.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_audit.h"
#include "tests/testing.h"

namespace mw::audit {
namespace {

using namespace test;

/// Spacings and origins that are no binary fractions.
const Frame kFrame{{0.3, 0.7, 1.1}, {1e3, -7.7, 0.1}};

/// Moves a vertex by whole lattice units.
void move(Position& p, const std::array<int, 3>& units, const Frame& frame) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = std::nearbyint((p[k] - frame.origin[k]) / frame.spacing[k] * kUnitsPerVoxel);
    p[k] = frame.origin[k] + frame.spacing[k] * ((at + units[k]) / kUnitsPerVoxel);
  }
}

std::array<int, 3> random_units(std::mt19937& random) {
  const auto unit = [&] { return static_cast<int>(below(random, 401)) - 200; };
  return {unit(), unit(), unit()};
}

/// Volumes of labels in voxels by long double.
std::vector<long double> plain_volumes(const SmallMesh& mesh, std::size_t labels, const Frame& f) {
  std::vector<long double> out(labels);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::array<std::array<long double, 3>, 3> e{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const long double a = mesh.vertices[mesh.tets[t][0]][k];
        e[i][k] = (mesh.vertices[mesh.tets[t][i + 1]][k] - a) / f.spacing[k];
      }
    }
    out[mesh.labels[t]] += std::abs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                                    e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                                    e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
                           6;
  }
  return out;
}

TEST(Promise8Volumes, AreExactOnTheLattice) {
  std::mt19937 random(821);
  for (int i = 0; i < 200 && !HasFailure(); ++i) {
    const SmallVolume v = random_volume(random);
    const VolumeReport report =
        measure_volumes(v.view(), v.label_count, five_tet_mesh(v, kFrame).view(), kFrame);
    EXPECT_TRUE(report.exact);
    for (const VolumeRow& row : report.per_label) {
      EXPECT_EQ(row.voxels, static_cast<std::uint64_t>(
                                std::count(v.labels.begin(), v.labels.end(), row.label)));
      EXPECT_EQ(row.volume_voxels, static_cast<double>(row.voxels));
      EXPECT_EQ(row.error, 0);
    }
  }
}

TEST(Promise8Volumes, OfMovedVerticesAreTheSumsOfTheirTets) {
  std::mt19937 random(822);
  for (int i = 0; i < 200 && !HasFailure(); ++i) {
    const SmallVolume v = random_volume(random);
    SmallMesh mesh = five_tet_mesh(v, kFrame);
    for (Position& p : mesh.vertices) move(p, random_units(random), kFrame);
    const bool on_lattice = i % 2 == 0;
    if (!on_lattice) mesh.vertices.front()[1] += 0.1 / kUnitsPerVoxel;
    const VolumeReport report = measure_volumes(v.view(), v.label_count, mesh.view(), kFrame);
    EXPECT_EQ(report.exact, on_lattice);
    const auto expected = plain_volumes(mesh, v.label_count, kFrame);
    for (const VolumeRow& row : report.per_label) {
      EXPECT_NEAR(row.volume_voxels, static_cast<double>(expected[row.label]), 1e-9);
      EXPECT_NEAR(row.error, row.volume_voxels / static_cast<double>(row.voxels) - 1, 1e-12);
    }
  }
}

/// One unit of the lattice in a volume of 2^60 voxels is not lost.
TEST(Promise8Volumes, ErrorsAreThoseOfTheDifference) {
  constexpr std::uint64_t kMany = std::uint64_t{1} << 60;
  const Int128 expected = Int128{kVoxelVolume6} * kMany;
  EXPECT_EQ(volume_row(3, kMany, expected).error, 0);
  EXPECT_GT(volume_row(3, kMany, expected + 1).error, 0);
  EXPECT_LT(volume_row(3, kMany, expected - 1).error, 0);
  EXPECT_EQ(volume_row(3, 2, kVoxelVolume6).error, -0.5);
  EXPECT_EQ(volume_row(3, 2, 3 * Int128{kVoxelVolume6}).volume_voxels, 3);
}

/// A tet of other tools may span all of a volume, farther than 64 bits go.
TEST(Promise8Volumes, OfLargeTetsAreExact) {
  const SmallVolume v = volume_from({1, 1, 1}, 1, [](auto, auto, auto) { return 0; });
  constexpr double kFar = 1 << 20;
  const SmallMesh mesh{{{0, 0, 0}, {kFar, 0, 0}, {0, kFar, 0}, {0, 0, kFar}}, {{0, 1, 2, 3}}, {0}};
  const VolumeReport report = measure_volumes(v.view(), 1, mesh.view(), {});
  EXPECT_TRUE(report.exact);
  EXPECT_EQ(report.per_label[0].volume_voxels, kFar * kFar * kFar / 6);
}

TEST(Promise8Volumes, OfLabelsThatTheVolumeDoesNotHaveAreNobodys) {
  const SmallVolume v = volume_from({2, 1, 1}, 3, [](auto x, auto, auto) { return 2 * x; });
  SmallMesh mesh = five_tet_mesh(v);
  std::replace(mesh.labels.begin(), mesh.labels.end(), Label{2}, kUnknown);
  const VolumeReport report = measure_volumes(v.view(), 3, mesh.view(), {});
  ASSERT_EQ(report.per_label.size(), 2U);  // label 1 has no voxel
  EXPECT_EQ(report.per_label[0].error, 0);
  EXPECT_EQ(report.per_label[1].error, -1);
}

/// Faces to other labels, by label, whatever tiles they are counted in; none at the box.
TEST(VoxelCount, HasTheFacesOfLayersBetweenLabels) {
  std::mt19937 random(12);
  for (int i = 0; i < 40; ++i) {
    const SmallVolume v = audit::test::random_volume(random);
    const Index3 layers{1, 2, 5};
    const Box3 all{{0, 0, 0}, v.shape};
    std::vector<std::uint64_t> faces(v.label_count), voxels(v.label_count);
    for_each_index(all, [&](Index3 at) {
      const auto label = [&](Index3 p) {
        return v.labels[static_cast<std::size_t>(all.offset(p))];
      };
      ++voxels[label(at)];
      const std::pair<Index3, std::uint64_t> ways[] = {{{1, 0, 0}, 10}, {{-1, 0, 0}, 10},
                                                       {{0, 1, 0}, 5},  {{0, -1, 0}, 5},
                                                       {{0, 0, 1}, 2},  {{0, 0, -1}, 2}};
      for (const auto& [step, count] : ways) {
        const Index3 other = at + step;
        if (all.contains(other) && label(other) != label(at)) faces[label(at)] += count;
      }
    });
    const auto counts = count_voxels(v.view(), all, all, v.label_count, layers);
    for (Label l = 0; l < v.label_count; ++l) {
      EXPECT_EQ(counts[l].voxels, voxels[l]);
      EXPECT_EQ(counts[l].faces, faces[l]);
    }
  }
}

TEST(VolumeBound, GrowsWithFacesOfRoughLabels) {
  EXPECT_EQ(volume_bound({.faces_a_voxel = 0.1}, 0.05), 0.05);
  EXPECT_EQ(volume_bound({.faces_a_voxel = 0.4}, 0.05), 0.05);
  EXPECT_DOUBLE_EQ(volume_bound({.faces_a_voxel = 4}, 0.05), 0.5);
}

/// Only labels of a thousand voxels and more are judged; the first of the worst is named.
TEST(VolumeMeter, JudgesLargeLabelsOnly) {
  VolumeMeter meter;
  EXPECT_FALSE(meter.summary().worst.has_value());
  meter.add({1, kMinJudgedVoxels - 1, 0, 0.9});
  EXPECT_EQ(meter.summary().labels_measured, 0U);
  meter.add({2, kMinJudgedVoxels, 0, 0.1});
  meter.add({3, 5000, 0, -0.3});
  meter.add({4, 5000, 0, 0.3});
  const VolumeSummary summary = meter.summary();
  EXPECT_EQ(summary.labels_measured, 3U);
  EXPECT_EQ(summary.worst->label, 3U);
  EXPECT_EQ(summary.error_max_abs, 0.3);
  EXPECT_NEAR(summary.error_mean_abs, 0.7 / 3, 1e-15);
}

/// A box of label 0 with a block of 10^3 voxels of label 1 and a bar of label 2 in it.
class JudgedVolumes : public ::testing::Test {
 protected:
  static constexpr std::int64_t kEdge = 14;

  [[nodiscard]] Check judge(std::optional<double> bound = 0.05) const {
    const AuditReport report = audit(volume_.view(), 3, mesh_.view(), {},
                                     {.measure_distance = false, .max_volume_error = bound});
    for (const Check& check : report.checks) {
      if (check.name == "P8 volumes") return check;
      EXPECT_TRUE(check.passed) << check.name << ": " << check.detail;
    }
    return {};
  }

  /// Vertices on the surface of label 1 go by `voxels` towards its centre, inner ones stay.
  void shrink(double voxels) {
    for (Position& p : mesh_.vertices) {
      if (std::none_of(p.begin(), p.end(), [](double x) { return x == 2 || x == 12; })) continue;
      if (std::any_of(p.begin(), p.end(), [](double x) { return x < 2 || x > 12; })) continue;
      for (double& x : p) x += x == 2 ? voxels : x == 12 ? -voxels : 0;
    }
  }

  SmallVolume volume_ = volume_from({kEdge, kEdge, kEdge}, 3, [](auto x, auto y, auto z) {
    const auto inside = [](auto v) { return v >= 2 && v < 12; };
    return inside(x) && inside(y) && inside(z) ? 1 : x == 0 && y == 0 ? 2 : 0;
  });
  SmallMesh mesh_ = five_tet_mesh(volume_);
};

TEST_F(JudgedVolumes, PassWhenTheyAreThoseOfTheVoxels) {
  EXPECT_TRUE(judge(0).passed) << judge(0).detail;
}

TEST_F(JudgedVolumes, FailWhenALabelShrinks) {
  shrink(0.0625);  // to (10 - 1/8)^3 voxels
  const double error = 1 - std::pow(9.875 / 10, 3);
  constexpr double kRough = 2.5 * 0.6;  // of a cube of 10 voxels: see volume_bound()
  EXPECT_TRUE(judge((error + 1e-6) / kRough).passed);
  const Check check = judge((error - 1e-6) / kRough);
  EXPECT_FALSE(check.passed);
  EXPECT_NE(check.detail.find("dense 1 (1000 voxels, 963 in"), std::string::npos) << check.detail;
  EXPECT_EQ(judge(std::nullopt).name, "");
}

TEST_F(JudgedVolumes, FailWhenALabelGrows) {
  shrink(-0.125);
  EXPECT_FALSE(judge().passed);
}

/// The block's label is then that of what is around it.
TEST_F(JudgedVolumes, FailWhenTwoLabelsAreSwapped) {
  for (Label& label : mesh_.labels) label = label == 0 ? 1 : label == 1 ? 0 : 2;
  const AuditReport report =
      audit(volume_.view(), 3, mesh_.view(), {}, {.measure_distance = false});
  const auto check = std::find_if(report.checks.begin(), report.checks.end(),
                                  [](const Check& c) { return c.name == "P8 volumes"; });
  ASSERT_NE(check, report.checks.end());
  EXPECT_FALSE(check->passed);
}

/// Labels too small to be judged may be off by any share.
TEST_F(JudgedVolumes, PassWhenOnlyASmallLabelIsOff) {
  for (Position& p : mesh_.vertices) {
    if (p[0] == 1 && p[1] == 1) p[0] = p[1] = 0.75;
  }
  EXPECT_TRUE(judge(0.02).passed) << judge(0.02).detail;
}

}  // namespace
}  // namespace mw::audit
