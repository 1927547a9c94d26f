// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Final blocks to one mesh: what a list of everything in memory would give, without one.
#include "engine/output/finish.h"

#include "tests/engine/figures_of.h"
#include "tests/engine/output/marched_blocks.h"
#include "tests/io/mesh/mesh_digest.h"
#include "tests/kernels/mesh/dense_mesh.h"
#include "tests/oracle/whole_audit.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;

/// All vertices ascending by id, all tets with wanted labels: the whole mesh in memory at once.
io::MeshData list_of_everything(FinalBlocks& blocks, const WindowGrid& grid,
                                const io::DenseVolume& volume, const WantedLabel& wanted) {
  std::map<VertexId, Point> used;
  std::vector<std::pair<std::array<VertexId, 4>, RawLabel>> tets;
  for_each_index(grid.blocks(), [&](Index3 b) {
    const BlockMesh block = blocks.load(b);
    for (const BlockTet& t : block.tets) {
      const RawLabel label = volume.table().raw(t.label);
      if (wanted && !wanted(label)) continue;
      tets.push_back({{}, label});
      for (std::size_t i = 0; i < 4; ++i) {
        const BlockVertex& v = block.vertices[t.vertices[i]];
        EXPECT_EQ(used.try_emplace(v.id, v.position).first->second, v.position);
        tets.back().first[i] = v.id;
      }
    }
  });
  io::MeshData out;
  std::map<VertexId, std::uint64_t> row;
  const io::VolumeInfo& info = volume.info();
  for (const auto& [id, p] : used) {
    row[id] = out.vertices.size();
    out.vertices.push_back({info.space.origin[0] + info.space.spacing[0] * (p.x / 1024.0),
                            info.space.origin[1] + info.space.spacing[1] * (p.y / 1024.0),
                            info.space.origin[2] + info.space.spacing[2] * (p.z / 1024.0)});
  }
  for (const auto& [ids, label] : tets) {
    out.tets.push_back({row[ids[0]], row[ids[1]], row[ids[2]], row[ids[3]]});
    out.labels.push_back(label);
  }
  return out;
}

/// Six-fold signed volume in physical units.
double volume6_of(const io::MeshData& mesh, const io::TetRows& t) {
  std::array<std::array<double, 3>, 3> edge{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      edge[i][k] = mesh.vertices[t[i + 1]][k] - mesh.vertices[t[0]][k];
    }
  }
  const auto& [a, b, c] = edge;
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Figures of the last pass are those of the audit, which holds the whole mesh.
void expect_same_shape(const FiguresAndVolumes& figures, const io::MeshData& mesh,
                       const Trial& trial, const WantedLabel& wanted) {
  const test::SmallMesh small = test::small_mesh(mesh);
  const audit::ShapeReport expected = measure_shape(small.view());
  const audit::ShapeReport& actual = figures.shape;
  EXPECT_EQ(actual.triangles, expected.triangles);
  EXPECT_NEAR(actual.area, expected.area, 1e-12 * expected.area);
  EXPECT_NEAR(actual.bend_max_deg, expected.bend_max_deg, 1e-9);
  EXPECT_NEAR(actual.sharp_share, expected.sharp_share, 1e-9);
  // Rounding may put an edge at the bound of two bins into either.
  EXPECT_NEAR(actual.bend_p50_deg, expected.bend_p50_deg, 0.11);
  EXPECT_NEAR(actual.bend_p95_deg, expected.bend_p95_deg, 0.11);
  EXPECT_NEAR(actual.bend_p99_deg, expected.bend_p99_deg, 0.11);
  const audit::VolumeReport volumes =
      measure_volumes(trial.volume.view(), trial.volume.label_count, small.view(), trial.frame);
  EXPECT_TRUE(volumes.exact);
  ASSERT_EQ(volumes.per_label.size(), figures.label_volumes6.size());
  for (std::size_t l = 0; l < volumes.per_label.size(); ++l) {
    const audit::VolumeRow& row = volumes.per_label[l];
    EXPECT_EQ(audit::volume_row(row.label, row.voxels, figures.label_volumes6[l]).error, row.error);
    const bool written = !wanted || wanted(test::raw_label(row.label));
    EXPECT_EQ(figures.label_volumes6[l] > 0, written);
  }
}

/// On any number of threads.
TEST(Finish, StreamsTheMeshThatAListOfEverythingGives) {
  std::mt19937 random(321);
  for (std::uint32_t i = 0; i < 40 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 1, 15);
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    Trial trial = random_trial(random, random_volume_of(random, kind, shape, 1 + i % 5));
    SCOPED_TRACE(trial.text());
    const MemoryVolume file(trial.volume, trial.frame);
    const io::LabelTable table = io::collect_labels(file);
    const io::DenseVolume volume(file, table);
    MarchedBlocks blocks(trial, volume);
    const WindowGrid& grid = blocks.grid();
    OutputOptions options;
    if (i % 3 == 0) options.wanted = [](RawLabel label) { return test::test_label(label) != 0; };
    MemorySink sink;
    const FinishedMesh finished = finish({blocks, grid, volume}, sink, options);
    const io::MeshData& mesh = sink.mesh();
    EXPECT_EQ(io::mesh_digest(mesh),
              io::mesh_digest(list_of_everything(blocks, grid, volume, options.wanted)));
    EXPECT_EQ(finished.vertices, mesh.vertices.size());
    EXPECT_EQ(finished.tets, mesh.tets.size());
    for (const io::TetRows& t : mesh.tets) EXPECT_GT(volume6_of(mesh, t), 0);
    const audit::QualityReport quality =
        measure_quality({.vertices = mesh.vertices, .tets = mesh.tets, .labels = {}});
    const FiguresAndVolumes figures = test::figures_of(mesh, volume);
    EXPECT_EQ(figures.quality.radius_ratio_min, quality.radius_ratio_min);
    EXPECT_EQ(figures.quality.radius_ratio_mean, quality.radius_ratio_mean);
    EXPECT_EQ(figures.quality.radius_ratio_histogram, quality.radius_ratio_histogram);
    EXPECT_EQ(figures.quality.worst_tet, quality.worst_tet);
    expect_same_shape(figures, mesh, trial, options.wanted);
    MemorySink again;
    options.work = {.threads = 2 + static_cast<int>(i % 3)};
    static_cast<void>(finish({blocks, grid, volume}, again, options));
    EXPECT_TRUE(again.mesh().vertices == mesh.vertices && again.mesh().tets == mesh.tets);
  }
}

/// Start blocks of a bar of noise, made when asked for.
class Bar : public FinalBlocks {
 public:
  explicit Bar(std::int64_t length)
      : volume_(mw::test::volume_from(
            {8, 8, length}, 2, [](auto x, auto y, auto z) { return (x * 5 + y * 3 + z) % 2; })),
        grid_(volume_.shape, 4) {}

  [[nodiscard]] BlockMesh load(Index3 block) override {
    return mw::test::dense_block(volume_, grid_.block_box(block));
  }
  [[nodiscard]] const audit::test::SmallVolume& volume() const { return volume_; }
  [[nodiscard]] const WindowGrid& grid() const { return grid_; }

 private:
  audit::test::SmallVolume volume_;
  WindowGrid grid_;
};

/// P6: what is remembered does not grow with the number of planes of blocks.
TEST(Promise6BoundedMemory, OfTheFinalMerge) {
  std::vector<std::size_t> max;
  for (const std::int64_t length : {12, 60, 240}) {
    Bar bar(length);
    const MemoryVolume file(bar.volume(), {});
    const io::LabelTable table = io::collect_labels(file);
    const io::DenseVolume volume(file, table);
    MemorySink sink;
    const FinishedMesh finished = finish({bar, bar.grid(), volume}, sink);
    EXPECT_EQ(finished.vertices, static_cast<std::uint64_t>(9 * 9 * (length + 1)));
    max.push_back(finished.max_remembered);
  }
  // Two planes of blocks and a line, two voxels thick each, and the far side.
  EXPECT_LE(max[0], 9U * 9U * 7U);
  EXPECT_EQ(max[1], max[2]);
}

}  // namespace
}  // namespace mw::engine
