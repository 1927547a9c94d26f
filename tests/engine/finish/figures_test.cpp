// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Figures of a finished mesh, against those of the same mesh in memory.
#include "engine/finish/figures.h"

#include <cmath>
#include <numeric>

#include "engine/connect/row_ranges.h"
#include "engine/finish/edges.h"
#include "engine/finish/interface_shape.h"
#include "io/mesh/mesh_data.h"
#include "kernels/core/error.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_audit.h"
#include "tests/temp_folder.h"
#include "tests/testing.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using ::mw::test::TempFolder;

constexpr std::size_t kSortBytes = 1 << 12;

io::MeshData as_data(const SmallMesh& mesh) {
  io::MeshData out;
  out.vertices = mesh.vertices;
  out.tets = mesh.tets;
  out.labels.assign(mesh.labels.begin(), mesh.labels.end());
  return out;
}

/// A mesh of a random volume, as it lies in files.
struct Stored {
  explicit Stored(const io::MeshData& data) : mesh(folder.path()) {
    io::ScratchMeshSink into(mesh);
    io::write_mesh(data, into);
  }

  TempFolder folder;
  io::ScratchMesh mesh;
};

void expect_same(const audit::ShapeReport& actual, const audit::ShapeReport& expected) {
  EXPECT_EQ(actual.triangles, expected.triangles);
  EXPECT_NEAR(actual.area, expected.area, 1e-12 * expected.area);
  EXPECT_NEAR(actual.bend_max_deg, expected.bend_max_deg, 1e-6);
  EXPECT_NEAR(actual.bend_p50_deg, expected.bend_p50_deg, 0.11);
  EXPECT_NEAR(actual.bend_p95_deg, expected.bend_p95_deg, 0.11);
  EXPECT_NEAR(actual.sharp_share, expected.sharp_share, 1e-9);
}

TEST(InterfaceShape, IsWhatTheAuditMeasures) {
  std::mt19937 random(841);
  for (int i = 0; i < 100 && !HasFailure(); ++i) {
    const audit::Frame frame{{0.5, 1, 2}, {-1, 0, 3}};
    SmallMesh mesh = five_tet_mesh(random_volume(random), frame);
    for (auto& p : mesh.vertices) p[static_cast<std::size_t>(i) % 3] += 1e-4 * below(random, 1000);
    if (i % 4 == 0) {
      for (auto& tet : mesh.tets) std::swap(tet[1], tet[2]);
    }
    Stored stored(as_data(mesh));
    expect_same(interface_shape(stored.mesh, kSortBytes), audit::test::measure_shape(mesh.view()));
  }
}

TEST(InterfaceShape, IsTheSameInManyRangesOnAnyNumberOfThreads) {
  std::mt19937 random(844);
  const SmallVolume volume = random_volume_of(random, VolumeKind::kNoise, {16, 15, 14}, 4);
  SmallMesh mesh = five_tet_mesh(volume, {});
  ASSERT_GT(mesh.vertices.size(), 3 * kRowsARange);
  for (auto& p : mesh.vertices) p[0] += 1e-4 * below(random, 1000);
  Stored stored(as_data(mesh));
  const audit::ShapeReport alone = interface_shape(stored.mesh, kSortBytes);
  expect_same(alone, audit::test::measure_shape(mesh.view()));
  const audit::ShapeReport shared =
      interface_shape(stored.mesh, kSortBytes, {.how = {.threads = 3}});
  EXPECT_EQ(shared.area, alone.area);
  EXPECT_EQ(shared.sharp_share, alone.sharp_share);
  EXPECT_EQ(shared.bend_histogram, alone.bend_histogram);
}

/// What a mesh looks like does not depend on whether its vertices were doubled.
TEST(Figures, AreThoseBeforeVerticesWereDoubled) {
  std::mt19937 random(842);
  for (int i = 0; i < 10; ++i) {
    const SmallMesh mesh = five_tet_mesh(random_volume(random), {});
    io::MeshData doubled = as_data(mesh);
    doubled.record.has_doubles = true;
    for (std::size_t t = 0; t < doubled.tets.size(); ++t) {
      if (doubled.labels[t] != 0) continue;
      for (std::uint64_t& row : doubled.tets[t]) {
        doubled.vertices.push_back(doubled.vertices[row]);
        row = doubled.vertices.size() - 1;
      }
    }
    Stored stored(doubled);
    const MeshFigures figures = measure(stored.mesh, {.sort_bytes = kSortBytes});
    expect_same(figures.shape, audit::test::measure_shape(mesh.view()));
  }
}

TEST(Figures, RefuseTetsOfVerticesThatAreNotThere) {
  io::MeshData mesh;
  mesh.vertices.resize(3);
  mesh.tets = {{0, 1, 2, 3}};
  mesh.labels = {0};
  Stored stored(mesh);
  EXPECT_THROW(static_cast<void>(measure(stored.mesh, {.sort_bytes = kSortBytes})), Error);
}

/// Against all pairs of corners of all tets of a label.
TEST(Edges, AreCountedAndTheLongestOfEachLabelFound) {
  std::mt19937 random(391);
  std::uniform_real_distribution<double> place(-3, 7);
  const io::LabelTable table({10, 11, 12, 13, 14}, false);
  io::MeshData mesh;
  std::vector<double> expected(table.size(), 0.0);
  std::uint64_t edges = 0;
  for (int t = 0; t < 60; ++t) {
    const Label label = below(random, 4);  // the last has no tet
    const std::uint64_t first = mesh.vertices.size();
    for (int i = 0; i < 4; ++i) mesh.vertices.push_back({place(random), place(random), 1.0 * i});
    mesh.tets.push_back({first, first + 1, first + 2, first + 3});
    mesh.labels.push_back(table.raw(label));
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) {
        const io::Position &a = mesh.vertices[first + i], &b = mesh.vertices[first + k];
        const double length = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        expected[label] = std::max(expected[label], length);
        edges += label == 2 && length <= 0.6 * 4.0 ? 1U : 0U;
      }
    }
  }
  Stored stored(mesh);
  const EdgeFigures figures =
      measure_edges(stored.mesh, {.table = table, .sizes = {0, 0, 4.0, 0, 0}});
  ASSERT_EQ(figures.longest.size(), table.size());
  EXPECT_EQ(figures.longest.back(), 0.0);
  for (std::size_t label = 0; label < table.size(); ++label) {
    EXPECT_DOUBLE_EQ(figures.longest[label], expected[label]);
  }
  const auto& counts = figures.ratios.counts;
  EXPECT_EQ(counts[0] + counts[1] + counts[2], edges);
  EXPECT_GT(edges, 0U);
}

/// The three edges of a triangle that tets of two labels share are at an interface.
TEST(Edges, AtInterfacesAreThoseBetweenVerticesWhereLabelsMeet) {
  io::MeshData mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  const io::LabelTable table({5, 6}, false);
  const auto sum = [](const std::vector<std::uint64_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  };
  for (const RawLabel other : {5U, 6U}) {
    mesh.labels = {5, other};
    Stored stored(mesh);
    const EdgeFigures figures = measure_edges(stored.mesh, {.table = table, .sizes = {1.0, 1.0}});
    EXPECT_EQ(sum(figures.ratios.at_interfaces), other == 5 ? 0U : 6U);
    EXPECT_EQ(sum(figures.ratios.counts), 12U);
  }
}

}  // namespace
}  // namespace mw::engine
