// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The graded start mesh: conforming, exact, of the voxels' topology, the same from every block.
#include "kernels/lattice/graded_start.h"

#include <gtest/gtest.h>

#include "kernels/quality/mesh_quality.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

BlockMesh graded_whole(const SmallVolume& volume, int level) {
  return start_block(volume, level_map(volume), {{0, 0, 0}, volume.shape}, {.max_level = level});
}

/// Mostly uniform, so that there are larger cells.
SmallVolume random_coarse(std::mt19937& random, std::int64_t edge) {
  constexpr std::array<VolumeKind, 4> kKinds{VolumeKind::kBlobs, VolumeKind::kShells,
                                             VolumeKind::kSpecks, VolumeKind::kRings};
  const Index3 shape{edge + below(random, 4), edge + below(random, 3), edge + below(random, 2)};
  SmallVolume volume =
      random_volume_of(random, kKinds[below(random, 4)], shape, 1 + below(random, 3));
  // Uniform from the middle on, for larger cells next to small ones.
  Index3 v;
  for (std::size_t i = 0; i < volume.labels.size(); ++i) {
    v = {static_cast<std::int64_t>(i) % shape.x, static_cast<std::int64_t>(i) / shape.x % shape.y,
         static_cast<std::int64_t>(i) / shape.x / shape.y};
    if (v.x + v.y > edge) volume.labels[i] = 0;
  }
  return volume;
}

TEST(Sec51GradedStart, FillsTheBoxExactlyWithConformingGoodTets) {
  std::mt19937 random(511);
  std::size_t tets = 0, dense_tets = 0;
  double worst = 1.0;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    const int level = 1 + i % 3;
    const SmallVolume volume = random_coarse(random, level == 3 ? 16 : 9);
    BlockMesh block = graded_whole(volume, level);
    const TetMesh mesh(block.vertices, block.tets, far_corner(volume.shape));
    std::int64_t sum = 0;
    for (const LocalTet& t : mesh.tets()) {
      sum += volume6_of(mesh, t);
      worst = std::min(worst, radius_ratio(mesh, Metric(), t));
    }
    EXPECT_EQ(sum, (6 * volume.shape.product()) << 30);
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) EXPECT_TRUE(mesh.is_free(v));
    for (const auto& [key, stars] : tets_by_stars(mesh)) {
      ASSERT_EQ(stars, key.label == kExterior ? 3 : 4);
    }
    tets += mesh.tets().size();
    dense_tets += volume.labels.size() * 5;
  }
  EXPECT_LT(tets, dense_tets * 3 / 4);
  EXPECT_GE(worst, 0.2) << "the default quality floor could not be promised";
}

TEST(Promise1Topology, HoldsInGradedStartMeshes) {
  std::mt19937 random(512);
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    const SmallVolume volume = random_coarse(random, 4);
    SCOPED_TRACE(volume.text());
    const BlockMesh block = graded_whole(volume, 1 + i % 2);
    const TetMesh mesh(block.vertices, block.tets, far_corner(volume.shape));
    EXPECT_TRUE(betti(mesh, volume.label_count) == betti(volume));
  }
}

TEST(Sec51GradedStart, IsTheSameHoweverItIsCutIntoBlocks) {
  std::mt19937 random(514);
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    const int level = 1 + i % 3;
    const SmallVolume volume = random_coarse(random, level == 3 ? 17 : 9);
    const BlockMesh whole = graded_whole(volume, level);
    const LevelMap levels = level_map(volume);
    std::map<VertexId, BlockVertex> vertices;
    for (const BlockVertex& v : whole.vertices) vertices[v.id] = v;
    GlobalTets expected, found;
    add_global(expected, whole);
    const std::int64_t edge = std::int64_t{1} << level;
    const Index3 s = volume.shape;
    for (Index3 lo; lo.z < s.z; lo.z += edge) {
      for (lo.y = 0; lo.y < s.y; lo.y += edge) {
        for (lo.x = 0; lo.x < s.x; lo.x += edge) {
          const Box3 box{
              lo,
              {std::min(lo.x + edge, s.x), std::min(lo.y + edge, s.y), std::min(lo.z + edge, s.z)}};
          const BlockMesh block = start_block(volume, levels, box, {.max_level = level});
          add_global(found, block);
          for (const BlockVertex& v : block.vertices) EXPECT_EQ(vertices.at(v.id), v);
        }
      }
    }
    EXPECT_TRUE(found == expected);
  }
}

}  // namespace
}  // namespace mw::test
