// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The floor that start meshes keep, against cells and start meshes of many kinds.
#include "kernels/start/start_quality.h"

#include <gtest/gtest.h>

#include "kernels/core/layers.h"
#include "kernels/quality/mesh_quality.h"
#include "kernels/start/cell_template.h"
#include "tests/kernels/start/coarse_volume.h"
#include "tests/kernels/start/large_cells.h"

namespace mw::test {
namespace {

constexpr int kLargest = 4;
constexpr double kRounding = 1e-12;

Metric random_metric(std::mt19937& random) {
  const auto length = [&] { return 1.0 + 0.01 * below(random, 300); };
  return Metric({length(), length(), length()});
}

CellNodes random_nodes(std::mt19937& random) {
  CellNodes nodes = kCellCorners;
  for (CellNode n = 0; n <= 26; ++n) {
    if (n != kCellCentre && below(random, 3) == 0) nodes |= 1U << n;
  }
  return nodes;
}

TEST(Promise3Quality, StartKeepsEveryFloorOfIsotropicVoxels) {
  EXPECT_NEAR(min_start_ratio(Metric(), 0), std::sqrt(3.0) - 1, 1e-12);
  for (int level = 1; level <= kLargest; ++level) {
    EXPECT_GE(min_start_ratio(Metric(), level), 0.5) << "the highest floor that may be asked";
  }
}

TEST(Promise3Quality, NoCellIsWorseThanTheFloorOfTheStart) {
  std::mt19937 random(721);
  for (int i = 0; i < 3000 && !HasFailure(); ++i) {
    const Metric metric = i % 3 == 0 ? Metric() : random_metric(random);
    const double floor = min_start_ratio(metric, 1);
    const double asked = floor * (0.25 + 0.25 * below(random, 4));
    const CellNodes nodes = random_nodes(random);
    const CellTemplate cell = cut_cell(nodes, i % 2 == 0, metric, asked);
    EXPECT_GE(worst_ratio(cell.tets, metric), asked - kRounding) << nodes;
    for (const NodeTriangle& t : cell.surface) {
      const std::vector<NodeTet> mixed{{kCellCentre, t[0], t[1], t[2]}};
      EXPECT_GE(worst_ratio(mixed, metric), floor - kRounding) << nodes;
    }
  }
}

TEST(Promise3Quality, StartMeshesKeepTheFloorAtAnySpacing) {
  std::mt19937 random(722);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Metric metric = i % 4 == 0 ? Metric() : random_metric(random);
    const int level = static_cast<int>(below(random, 4));
    const double floor = min_start_ratio(metric, level);
    const Index3 shape{6 + below(random, 12), 6 + below(random, 12), 6 + below(random, 12)};
    const SmallVolume volume =
        random_volume_of(random, VolumeKind::kBlobs, shape, 1 + below(random, 4));
    BlockMesh block = start_block(volume, level_map(volume), {{0, 0, 0}, shape},
                                  {.max_level = level, .metric = metric, .quality_floor = floor});
    const TetMesh mesh(block.vertices, block.tets, far_corner(shape));
    for (const LocalTet& t : mesh.tets()) {
      EXPECT_GE(radius_ratio(mesh, metric, t), floor - kRounding);
    }
  }
}

/// Layers leave spacings at which the start keeps the default floor with something to spare.
TEST(Promise3Quality, StartKeepsTheDefaultFloorOnceSlicesAreCut) {
  double min = 1.0;
  for (double y = 1.0; y < 20.5; y += y < 4 ? 0.05 : 0.3) {
    for (double z = y; z < 20.5; z += z < 4 ? 0.05 : 0.3) {
      const std::array<double, 3> spacing{1, y, z};
      const Metric metric(layered_spacing(spacing, layers_of(spacing)));
      min = std::min(min, min_start_ratio(metric, kLargest));
    }
  }
  EXPECT_GE(min, 0.3);
}

}  // namespace
}  // namespace mw::test
