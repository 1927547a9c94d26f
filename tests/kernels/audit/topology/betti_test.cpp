// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// P1: Betti numbers of volumes and meshes against ranks of boundary matrices.
#include "kernels/audit/topology/betti.h"

#include "kernels/core/error.h"
#include "tests/kernels/audit/topology/random_labels.h"
#include "tests/oracle/cell_complex.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_audit.h"
#include "tests/testing.h"

namespace mw::audit {

void PrintTo(const RegionBetti& betti, std::ostream* out) {
  const auto print = [&](const Betti& b) {
    *out << "(" << b.b0 << "," << b.b1 << "," << b.b2 << ")";
  };
  print(betti.closed);
  print(betti.open);
}

namespace {

using namespace test;

constexpr RegionBetti kBall{{1, 0, 0}, {1, 0, 0}};
constexpr RegionBetti kNothing{{0, 0, 0}, {0, 0, 0}};

TEST(VoxelBetti, AgreesWithRanksOnRandomVolumes) {
  std::mt19937 random(1);
  int pinched = 0, tunnelled = 0, hollow = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const SmallVolume v = random_volume(random);
    const auto expected = betti_of(complex_of(v.view(), v.label_count), v.label_count);
    ASSERT_EQ(voxel_betti(v.view(), v.label_count), expected) << v.text();
    for (const RegionBetti& b : expected) {
      pinched += b.closed != b.open ? 1 : 0;
      tunnelled += b.closed.b1 > 0 && b.open.b1 > 0 ? 1 : 0;
      hollow += b.closed.b2 > 0 && b.open.b2 > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(pinched, 1000);
  EXPECT_GT(tunnelled, 200);
  EXPECT_GT(hollow, 200);
}

TEST(MeshBetti, AgreesWithVoxelsOnFiveTetMeshes) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 4000; ++trial) {
    const SmallVolume v = random_volume(random);
    const SmallMesh mesh = five_tet_mesh(v);
    ASSERT_EQ(mesh_betti(mesh.view(), v.label_count), voxel_betti(v.view(), v.label_count))
        << v.text();
  }
}

TEST(MeshBetti, AgreesWithRanksOnRandomlyLabelledTets) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 500; ++trial) {
    SmallVolume v = random_volume(random);
    v.shape = {1 + v.shape.x % 3, 1 + v.shape.y % 3, 1 + v.shape.z % 3};
    v.labels.assign(static_cast<std::size_t>(v.shape.product()), 0);
    SmallMesh mesh = five_tet_mesh(v);
    const std::uint32_t labels = 1 + below(random, 6);
    const std::uint32_t runs = 1 + below(random, 4);
    test::paint_in_runs(random, labels, runs, mesh);
    const auto expected = betti_of(complex_of(mesh.view(), labels), labels);
    ASSERT_EQ(mesh_betti(mesh.view(), labels), expected) << trial;
  }
}

TEST(MeshBetti, DoesNotDependOnTheOrderOfVerticesAndTets) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const SmallVolume v = random_volume(random);
    SmallMesh mesh = five_tet_mesh(v);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const std::size_t other = below(random, static_cast<std::uint32_t>(mesh.tets.size()));
      std::swap(mesh.tets[t], mesh.tets[other]);
      std::swap(mesh.labels[t], mesh.labels[other]);
    }
    const std::size_t count = mesh.vertices.size();
    for (TetRow& tet : mesh.tets) {
      for (auto& vertex : tet) vertex = (vertex + count / 2) % count;
      std::swap(tet[below(random, 4)], tet[below(random, 4)]);
    }
    ASSERT_EQ(mesh_betti(mesh.view(), v.label_count), voxel_betti(v.view(), v.label_count));
  }
}

TEST(VoxelBetti, OneLabelIsABallAndSoIsTheExterior) {
  const SmallVolume v = volume_from({3, 4, 5}, 1, [](auto, auto, auto) { return 0; });
  EXPECT_EQ(voxel_betti(v.view(), 1), (std::vector<RegionBetti>{kBall, kBall}));
  EXPECT_EQ(mesh_betti(five_tet_mesh(v).view(), 1), (std::vector<RegionBetti>{kBall, kBall}));
}

TEST(VoxelBetti, LabelThatDoesNotOccurIsNothing) {
  const SmallVolume v = volume_from({2, 2, 2}, 3, [](auto, auto, auto) { return 1; });
  const std::vector<RegionBetti> expected{kNothing, kBall, kNothing, kBall};
  EXPECT_EQ(voxel_betti(v.view(), 3), expected);
  EXPECT_EQ(mesh_betti(five_tet_mesh(v).view(), 3), expected);
}

TEST(VoxelBetti, ShellHasACavityAndRingATunnel) {
  const SmallVolume shell = volume_from(
      {3, 3, 3}, 2, [](auto x, auto y, auto z) { return x == 1 && y == 1 && z == 1 ? 1 : 0; });
  const RegionBetti cavity{{1, 0, 1}, {1, 0, 1}};
  EXPECT_EQ(voxel_betti(shell.view(), 2), (std::vector<RegionBetti>{cavity, kBall, kBall}));
  const SmallVolume ring =
      volume_from({3, 3, 1}, 2, [](auto x, auto y, auto) { return x == 1 && y == 1 ? 1 : 0; });
  const RegionBetti tunnel{{1, 1, 0}, {1, 1, 0}};
  EXPECT_EQ(voxel_betti(ring.view(), 2), (std::vector<RegionBetti>{tunnel, kBall, kBall}));
}

TEST(VoxelBetti, VoxelsAtAnEdgeAreOneClosedAndTwoOpen) {
  const SmallVolume v = volume_from({2, 2, 1}, 2, [](auto x, auto y, auto) { return (x + y) % 2; });
  const RegionBetti pinched{{1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(voxel_betti(v.view(), 2), (std::vector<RegionBetti>{pinched, pinched, kBall}));
}

TEST(VoxelBetti, RefusesUnsoundInput) {
  const std::vector<Label> labels{0, 1};
  EXPECT_THROW((void)voxel_betti({{1, 1, 1}, labels}, 2), Error);
  EXPECT_THROW((void)voxel_betti({{2, 1, 1}, labels}, 1), Error);
  EXPECT_THROW((void)voxel_betti({{0, 1, 1}, {}}, 1), Error);
}

TEST(MeshBetti, RefusesUnsoundInput) {
  const std::vector<Position> vertices(4);
  const std::vector<TetRow> tets{{0, 1, 2, 4}};
  const std::vector<Label> labels{0};
  EXPECT_THROW((void)mesh_betti({vertices, tets, labels}, 1), Error);
  EXPECT_THROW((void)mesh_betti({vertices, tets, {}}, 1), Error);
}

TEST(MeshBetti, SurvivesTetsThatNameAVertexTwice) {
  const SmallVolume v = volume_from({2, 2, 2}, 1, [](auto, auto, auto) { return 0; });
  SmallMesh mesh = five_tet_mesh(v);
  mesh.tets.insert(mesh.tets.begin(), {0, 0, 1, 2});
  mesh.labels.insert(mesh.labels.begin(), 0);
  EXPECT_EQ(mesh_betti(mesh.view(), 1), voxel_betti(v.view(), 1));
}

}  // namespace
}  // namespace mw::audit
