// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Grids of cubes cut once and twice, against what was there before.
#include "io/mesh/grouped/halved_mesh.h"

#include "kernels/core/tet_nodes.h"
#include "kernels/quality/quality.h"
#include "tests/expect_error.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

/// Remembers how many tets were announced, too, and how often it was finished.
class CollectedMesh : public MeshDataSink {
 public:
  void begin(const MeshHeader& header) override {
    announced = header.tets;
    MeshDataSink::begin(header);
  }
  void finish() override { ++finished; }

  std::uint64_t announced = 0;
  int finished = 0;
};

double volume6_in(const MeshData& mesh, const TetRows& t) {
  return volume6_of(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]],
                    mesh.vertices[t[3]]);
}

std::map<RawLabel, double> volumes_of(const MeshData& mesh) {
  std::map<RawLabel, double> out;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    out[mesh.labels[t]] += volume6_in(mesh, mesh.tets[t]);
  }
  return out;
}

/// Triangles by how many tets have them.
std::map<std::set<std::uint64_t>, int> triangles_of(const MeshData& mesh) {
  std::map<std::set<std::uint64_t>, int> out;
  for (const TetRows& tet : mesh.tets) {
    for (const std::uint64_t left_out : tet) {
      std::set<std::uint64_t> face(tet.begin(), tet.end());
      face.erase(left_out);
      ++out[face];
    }
  }
  return out;
}

std::size_t edges_of(const MeshData& mesh) {
  std::set<std::set<std::uint64_t>> out;
  for (const TetRows& t : mesh.tets) {
    for (const auto& [a, b] : kTetEdges) out.insert({t[a], t[b]});
  }
  return out.size();
}

std::unique_ptr<ScratchMesh> stored(const MeshData& mesh, const TempDir& dir) {
  auto out = std::make_unique<ScratchMesh>(dir.path());
  ScratchMeshSink into(*out);
  write_mesh(mesh, into);
  return out;
}

TEST(HalvedMesh, EachTetBecomesEight) {
  const TempDir dir;
  for (unsigned seed = 0; seed < 6; ++seed) {
    MeshData mesh = grid_mesh({3, 2, 1 + seed % 3}, seed);
    mesh.record.promises = MeshPromises{.quality_floor = 0.2};
    CollectedMesh out;
    std::size_t asked = 0;
    halve(*stored(mesh, dir), out, {}, [&] { ++asked; });
    EXPECT_EQ(out.finished, 1);
    EXPECT_EQ(out.announced, 8 * mesh.tets.size());
    EXPECT_EQ(out.mesh().record.promises->halvings, 1);
    EXPECT_EQ(out.mesh().record.promises->quality_floor, 0.2);
    EXPECT_EQ(out.mesh().tets.size(), 8 * mesh.tets.size());
    EXPECT_GT(asked, 0U);
    EXPECT_EQ(out.mesh().vertices.size(), mesh.vertices.size() + edges_of(mesh));
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      EXPECT_EQ(out.mesh().vertices[v], mesh.vertices[v]);
    }
    const std::set<Position> places(out.mesh().vertices.begin(), out.mesh().vertices.end());
    EXPECT_EQ(places.size(), out.mesh().vertices.size());
    for (const TetRows& tet : out.mesh().tets) EXPECT_GT(volume6_in(out.mesh(), tet), 0);
    EXPECT_EQ(volumes_of(out.mesh()), volumes_of(mesh));  // exact: multiples of 1/8
    const auto before = triangles_of(mesh), after = triangles_of(out.mesh());
    std::array<std::size_t, 3> counts{}, wanted{};
    for (const auto& [face, count] : before) wanted.at(static_cast<std::size_t>(count)) += 4;
    for (const auto& [face, count] : after) ++counts.at(static_cast<std::size_t>(count));
    EXPECT_EQ(counts[1], wanted[1]);
    EXPECT_EQ(counts[2], wanted[2] + 8 * mesh.tets.size());  // eight inside of each tet
  }
}

double worst_ratio(const MeshData& mesh) {
  double out = 1;
  for (const TetRows& tet : mesh.tets) {
    std::array<Vec3, 4> at;
    for (std::size_t i = 0; i < 4; ++i) {
      const Position& p = mesh.vertices[tet[i]];
      at[i] = {p[0], p[1], p[2]};
    }
    out = std::min(out, radius_ratio({at[1] - at[0], at[2] - at[0], at[3] - at[0]}));
  }
  return out;
}

TEST(HalvedMesh, CurvesMoveNodesNoFartherThanTheyMayAndKeepTetsGood) {
  const TempDir dir;
  std::size_t moved = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    MeshData mesh = grid_mesh({4, 4, 4}, seed);
    shake(mesh, 4, seed);
    for (RawLabel& label : mesh.labels) label /= 2;
    mesh.record.box = MeshBox{.edges = {{{4, 0, 0}, {0, 4, 0}, {0, 0, 4}}}};
    mesh.record.promises = MeshPromises{.max_distance = 1.2, .quality_floor = 0.3};
    CollectedMesh straight, curved;
    halve(*stored(mesh, dir), straight);
    const double most_move = seed % 2 == 0 ? 0.02 : 0.2;
    halve(*stored(mesh, dir), curved, HalvedCurves{.most_move = most_move, .max_distance = 1.5});
    EXPECT_EQ(curved.mesh().record.promises->max_distance, 1.5);
    EXPECT_EQ(straight.mesh().record.promises->max_distance, 1.2);
    EXPECT_FALSE(curved.mesh().record.curved);
    EXPECT_GE(worst_ratio(curved.mesh()), std::min(0.2, 0.75 * worst_ratio(straight.mesh())));
    EXPECT_EQ(curved.mesh().labels, straight.mesh().labels);
    ASSERT_EQ(curved.mesh().vertices.size(), straight.mesh().vertices.size());
    for (std::size_t v = 0; v < curved.mesh().vertices.size(); ++v) {
      const Position &p = straight.mesh().vertices[v], &q = curved.mesh().vertices[v];
      const double length = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      EXPECT_LE(length, most_move * (1 + 1e-12));
      moved += length > 1e-9 ? 1U : 0U;
    }
  }
  EXPECT_GT(moved, 200U);
}

TEST(HalvedMesh, TwiceCutsTwice) {
  const TempDir dir;
  const MeshData mesh = grid_mesh({2, 2, 1}, 7);
  CollectedMesh once, out;
  MeshData promised = mesh;
  promised.record.promises = MeshPromises{.quality_floor = 0.2};
  halve(*stored(promised, dir), once);
  halve(*stored(once.mesh(), dir), out);
  EXPECT_EQ(out.mesh().record.promises->halvings, 2);
  EXPECT_EQ(out.mesh().tets.size(), 64 * mesh.tets.size());
  EXPECT_EQ(volumes_of(out.mesh()), volumes_of(mesh));
}

TEST(HalvedMesh, PartsHaveTheValuesOfTheirTet) {
  const TempDir dir;
  const MeshData mesh = grid_mesh({2, 1, 1}, 3);
  CollectedMesh out;
  ScratchMesh columns(dir.path());
  ScratchMeshSink sink(columns);
  MeshHeader header{.tets = mesh.tets.size()};
  header.values = {"x", "row"};
  sink.begin(header);
  sink.write_vertices(mesh.vertices);
  sink.write_tets(mesh.tets, mesh.labels);
  std::vector<double> rows;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    rows.push_back(static_cast<double>(mesh.labels[t]));
    rows.push_back(volume6_in(mesh, mesh.tets[t]));
  }
  sink.write_values(rows);
  sink.finish();
  halve(columns, out);
  const std::vector<TetRows>& tets = out.mesh().tets;
  ASSERT_EQ(out.mesh().values.size(), 2U);
  ASSERT_EQ(out.mesh().values[1].numbers.size(), tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t) {
    EXPECT_EQ(out.mesh().values[0].numbers[t], static_cast<double>(out.mesh().labels[t]));
    EXPECT_EQ(out.mesh().values[1].numbers[t], 8 * volume6_in(out.mesh(), tets[t]));
  }
}

}  // namespace
}  // namespace mw::io
