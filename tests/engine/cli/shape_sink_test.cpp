// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Figures of a mesh that streams by, against those of the same mesh in memory.
#include "engine/cli/info/shape_sink.h"

#include <gtest/gtest.h>

#include <random>

#include "io/file/scratch/scratch_file.h"
#include "kernels/audit/shape/volumes.h"
#include "kernels/core/error.h"
#include "tests/oracle/small_volumes.h"

namespace mw::cli {
namespace {

using audit::test::SmallMesh;
using audit::test::SmallVolume;

/// Vertices and tets by turns, a few at a time: each tet as soon as its vertices are there.
void stream(const SmallMesh& mesh, std::size_t batch, io::MeshSink& sink) {
  std::vector<bool> written(mesh.tets.size());
  sink.begin({.tets = mesh.tets.size()});
  for (std::size_t first = 0; first < mesh.vertices.size(); first += batch) {
    const std::size_t end = std::min(first + batch, mesh.vertices.size());
    sink.write_vertices(std::span(mesh.vertices).subspan(first, end - first));
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      if (written[t] || *std::max_element(mesh.tets[t].begin(), mesh.tets[t].end()) >= end)
        continue;
      written[t] = true;
      const RawLabel label = mesh.labels[t];
      sink.write_tets(std::span(&mesh.tets[t], 1), std::span(&label, 1));
    }
  }
  sink.finish();
}

TEST(ShapeSink, MeasuresWhatTheAuditDoes) {
  std::mt19937 random(841);
  for (int i = 0; i < 100 && !HasFailure(); ++i) {
    const SmallVolume volume = audit::test::random_volume(random);
    const audit::Frame frame{{0.5, 1, 2}, {-1, 0, 3}};
    SmallMesh mesh = five_tet_mesh(volume, frame);
    for (auto& p : mesh.vertices)
      p[static_cast<std::size_t>(i) % 3] += 1e-4 * audit::test::below(random, 1000);
    if (i % 4 == 0) {
      for (auto& tet : mesh.tets) std::swap(tet[1], tet[2]);
    }
    ShapeSink sink(io::scratch_folder());
    stream(mesh, 1 + audit::test::below(random, 40), sink);
    const audit::ShapeReport actual = sink.shape();
    const audit::ShapeReport expected = audit::measure_shape(mesh.view());
    EXPECT_EQ(actual.triangles, expected.triangles);
    EXPECT_NEAR(actual.area, expected.area, 1e-12 * expected.area);
    EXPECT_NEAR(actual.bend_max_deg, expected.bend_max_deg, 1e-6);
    EXPECT_NEAR(actual.bend_p50_deg, expected.bend_p50_deg, 0.11);
    EXPECT_NEAR(actual.bend_p95_deg, expected.bend_p95_deg, 0.11);
    EXPECT_NEAR(actual.sharp_share, expected.sharp_share, 1e-9);
    const auto volumes =
        audit::measure_volumes(volume.view(), volume.label_count, mesh.view(), frame);
    ASSERT_EQ(sink.volumes().size(), volumes.per_label.size());
    for (const audit::VolumeRow& row : volumes.per_label) {
      EXPECT_NEAR(sink.volumes().at(row.label).value(), row.volume_voxels, 1e-9);  // a voxel is 1
    }
  }
}

TEST(ShapeSink, RefusesTetsOfVerticesThatHaveNotCome) {
  ShapeSink sink(io::scratch_folder());
  sink.begin({.tets = 1});
  sink.write_vertices(std::vector<io::Position>(3));
  const io::TetRows tet{0, 1, 2, 3};
  const RawLabel label = 0;
  EXPECT_THROW(sink.write_tets(std::span(&tet, 1), std::span(&label, 1)), Error);
}

}  // namespace
}  // namespace mw::cli
