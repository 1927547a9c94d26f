// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Area and bends of interfaces: known bodies, and random ones against the definition.
#include "kernels/audit/shape/shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/oracle/interface_bends.h"
#include "tests/oracle/small_volumes.h"

namespace mw::audit {
namespace {

using test::five_tet_mesh;
using test::InterfaceBends;
using test::random_volume;
using test::SmallMesh;
using test::SmallVolume;
using test::volume_from;

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

}  // namespace
}  // namespace mw::audit
