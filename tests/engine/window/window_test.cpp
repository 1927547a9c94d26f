// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Gather and scatter: a window's content goes to blocks and comes back the same.
#include "engine/window/window.h"
#include "kernels/mesh/block_mesh.h"

#include "kernels/optimise/optimise.h"
#include "kernels/simplify/simplify.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::engine {
namespace {

using namespace mw::test;

/// The start content of a window's blocks.
std::vector<BlockMesh> start_blocks(const SmallVolume& volume, const WindowGrid& grid,
                                    Index3 window) {
  std::vector<BlockMesh> out;
  for (Index3 b : grid.blocks_of(window)) {
    out.push_back(dense_block(volume, grid.block_box(b), {.with_samples = true}));
  }
  return out;
}

std::vector<BlockMesh> shuffled(std::vector<BlockMesh> blocks, std::mt19937& random) {
  for (std::size_t i = blocks.size(); i > 1; --i) {
    std::swap(blocks[i - 1], blocks[below(random, static_cast<std::uint32_t>(i))]);
  }
  return blocks;
}

void work_on(TetMesh& mesh) {
  simplify(mesh, Metric(), {});
  optimise(mesh, Metric(), {});
}

void expect_same_mesh(const TetMesh& actual, const TetMesh& expected) {
  ASSERT_EQ(actual.vertex_count(), expected.vertex_count());
  for (LocalVertex v = 0; v < actual.vertex_count(); ++v) {
    ASSERT_EQ(actual.vertex(v), expected.vertex(v));
    ASSERT_EQ(actual.is_free(v), expected.is_free(v));
    ASSERT_TRUE(std::ranges::equal(actual.star(v), expected.star(v)));
  }
}

GlobalTets global_tets(const TetMesh& mesh) {
  GlobalTets out;
  for (const LocalTet& t : mesh.tets()) {
    std::array<VertexId, 4> ids{};
    for (std::size_t i = 0; i < 4; ++i) ids[i] = mesh.vertex(t.vertices[i]).id;
    std::sort(ids.begin(), ids.end());
    out.insert({ids, t.label});
  }
  return out;
}

void expect_canonical(const BlockMesh& block) {
  std::set<std::uint32_t> used;
  for (const BlockTet& t : block.tets) {
    EXPECT_TRUE(std::is_sorted(t.vertices.begin(), t.vertices.end()));
    used.insert(t.vertices.begin(), t.vertices.end());
  }
  EXPECT_EQ(used.size(), block.vertices.size());
  EXPECT_TRUE(std::is_sorted(block.tets.begin(), block.tets.end()));
  EXPECT_TRUE(std::is_sorted(block.samples.begin(), block.samples.end()));
  for (std::size_t i = 1; i < block.samples.size(); ++i) {
    const BlockSample &a = block.samples[i - 1], &b = block.samples[i];
    EXPECT_FALSE(a.triangle == b.triangle && a.side == b.side &&
                 on_same_face(a.samples, b.samples));
  }
  for (std::size_t i = 1; i < block.vertices.size(); ++i) {
    EXPECT_LT(block.vertices[i - 1].id, block.vertices[i].id);
  }
}

/// Blocks hold the window's tets once, copies of a vertex are equal, and each block is canonical.
void expect_sound(const std::vector<BlockMesh>& blocks, const TetMesh& mesh) {
  GlobalTets dealt;
  std::map<VertexId, BlockVertex> copies;
  for (const BlockMesh& block : blocks) {
    expect_canonical(block);
    add_global(dealt, block);
    for (const BlockVertex& v : block.vertices) {
      EXPECT_EQ(copies.try_emplace(v.id, v).first->second, v);
    }
  }
  EXPECT_TRUE(dealt == global_tets(mesh));
}

/// Calls visit(volume, grid, window) for windows at faces, edges, corners and inside of volumes.
template <typename Visit>
void each_random_window(unsigned seed, Visit visit) {
  std::mt19937 random(seed);
  for (std::uint32_t i = 0; i < 60 && !::testing::Test::HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 1, 13);
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    const SmallVolume volume = random_volume_of(random, kind, shape, 1 + below(random, 5));
    const WindowGrid grid(volume.shape, i % 3 == 0 ? 4 : 6);
    const Index3 windows = grid.windows();
    const auto pick = [&](std::int64_t n) {
      return std::int64_t{below(random, static_cast<std::uint32_t>(n))};
    };
    const auto wx = pick(windows.x), wy = pick(windows.y), wz = pick(windows.z);
    visit(volume, grid, Index3{wx, wy, wz}, random);
  }
}

TEST(Promise5SameBytes, ScatterUndoesGatherOnStartBlocks) {
  each_random_window(861, [](const auto& volume, const auto& grid, Index3 window, auto&) {
    const auto blocks = start_blocks(volume, grid, window);
    const WindowContent content = gather(blocks, volume.shape);
    EXPECT_TRUE(scatter(content, grid, window) == blocks);
    expect_sound(blocks, content.mesh);
  });
}

TEST(Promise5SameBytes, GatherForgetsTheOrderOfBlocks) {
  each_random_window(862, [](const auto& volume, const auto& grid, Index3 window, auto& random) {
    const auto blocks = start_blocks(volume, grid, window);
    WindowContent reference = gather(blocks, volume.shape);
    work_on(reference.mesh);
    reference.samples = {};
    for (int i = 0; i < 4; ++i) {
      WindowContent content = gather(shuffled(blocks, random), volume.shape);
      EXPECT_TRUE(scatter(content, grid, window) == blocks);
      work_on(content.mesh);
      expect_same_mesh(content.mesh, reference.mesh);
      content.samples = {};
      EXPECT_TRUE(scatter(content, grid, window) == scatter(reference, grid, window));
    }
  });
}

TEST(Promise5SameBytes, GatherUndoesScatterOfASimplifiedWindow) {
  int simplified = 0;
  each_random_window(863, [&](const auto& volume, const auto& grid, Index3 window, auto& random) {
    WindowContent content = gather(start_blocks(volume, grid, window), volume.shape);
    content.samples = {};
    const std::size_t before = content.mesh.tets().size();
    work_on(content.mesh);
    simplified += content.mesh.tets().size() < before ? 1 : 0;
    const auto blocks = scatter(content, grid, window);
    expect_sound(blocks, content.mesh);
    const WindowContent again = gather(shuffled(blocks, random), volume.shape);
    EXPECT_TRUE(global_tets(again.mesh) == global_tets(content.mesh));
    EXPECT_TRUE(scatter(again, grid, window) == blocks);
  });
  EXPECT_GT(simplified, 20);
}

/// Free vertices are those whose tets are all in the window's blocks: another window that holds a
/// copy sees it fixed.
TEST(Sec41FreeVertices, OfWindowsThatShareNoBlockAreDifferent) {
  const SmallVolume volume =
      mw::test::volume_from({12, 4, 4}, 2, [](auto x, auto y, auto) { return (x / 3 + y) % 2; });
  const WindowGrid grid(volume.shape, 4);
  const TetMesh left = gather(start_blocks(volume, grid, {0, 0, 0}), volume.shape).mesh;
  const TetMesh right = gather(start_blocks(volume, grid, {2, 0, 0}), volume.shape).mesh;
  int shared = 0;
  for (LocalVertex v = 0; v < left.vertex_count(); ++v) {
    for (LocalVertex w = 0; w < right.vertex_count(); ++w) {
      if (left.vertex(v).id != right.vertex(w).id) continue;
      EXPECT_FALSE(left.is_free(v) || right.is_free(w));
      ++shared;
    }
  }
  EXPECT_EQ(shared, 25);
}

/// Changes of the mesh hand samples of a face over one by one; blocks hold them together again.
TEST(Promise5SameBytes, ScatterJoinsTheSamplesOfAFaceOnATriangle) {
  std::mt19937 random(209);
  std::size_t joined = 0;
  for (int i = 0; i < 20 && !HasFailure(); ++i) {
    const SmallVolume volume = random_volume_of(random, VolumeKind::kNoise, {8, 8, 8}, 3);
    const WindowGrid grid(volume.shape, 8);
    const std::vector<BlockMesh> blocks = start_blocks(volume, grid, {0, 0, 0});
    WindowContent content = gather(blocks, volume.shape);
    const std::vector<BlockMesh> expected = scatter(content, grid, {0, 0, 0});
    content.samples = {};
    for (const BlockSample& s : merge_blocks(blocks).samples) {
      for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
        const QuarterBits bit = quarters_of(s.samples) & 1U << quarter;
        if (bit == 0) continue;
        content.samples.add(s.triangle, s.side, with_quarters(s.samples, bit));
        joined += bit != quarters_of(s.samples) ? 1U : 0U;
      }
    }
    EXPECT_EQ(scatter(content, grid, {0, 0, 0}), expected);
  }
  EXPECT_GT(joined, 1000U);
}

}  // namespace
}  // namespace mw::engine
