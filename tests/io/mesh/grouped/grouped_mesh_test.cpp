// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Groups of a mesh against sets and maps.
#include <gmock/gmock.h>

#include "io/mesh/grouped/group_names.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/names/read_names.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/mesh/grouped/grouped.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

using Triangle = std::set<std::uint64_t>;

/// A triangle with a sign: even permutations are the same.
std::array<std::uint64_t, 3> turned(std::array<std::uint64_t, 3> rows) {
  std::rotate(rows.begin(), std::min_element(rows.begin(), rows.end()), rows.end());
  return rows;
}

struct Bounds {
  std::vector<RawLabel> labels;                     ///< of its tets, ascending
  std::vector<std::array<std::uint64_t, 3>> turns;  ///< out of those tets
};

/// Every triangle of the mesh; the corners of tets in every order, the outward one by volumes.
std::map<Triangle, Bounds> triangles_of(const MeshData& mesh) {
  std::map<Triangle, std::map<RawLabel, std::array<std::uint64_t, 3>>> by_label;
  std::map<Triangle, Bounds> out;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<std::uint64_t, 3> rows{};
      std::size_t n = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        if (i != left_out) rows[n++] = mesh.tets[t][i];
      }
      const auto at = [&](std::uint64_t row) { return mesh.vertices[row]; };
      if (volume6_of(at(rows[0]), at(rows[1]), at(rows[2]), at(mesh.tets[t][left_out])) > 0) {
        std::swap(rows[1], rows[2]);
      }
      Bounds& bounds = out[{rows.begin(), rows.end()}];
      bounds.labels.push_back(mesh.labels[t]);
      bounds.turns.push_back(turned(rows));
    }
  }
  return out;
}

/// Side of the box from 0 to the mesh's shape, by equality.
Side side_of(const MeshData& mesh, const Triangle& rows, const Position& extent) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double plane : {0.0, extent[axis]}) {
      if (std::all_of(rows.begin(), rows.end(),
                      [&](std::uint64_t row) { return mesh.vertices[row][axis] == plane; })) {
        return static_cast<Side>(1 + 2 * axis + (plane > 0 ? 1 : 0));
      }
    }
  }
  return Side::kOuter;
}

class RandomGrids : public testing::TestWithParam<unsigned> {
 protected:
  /// Labels far apart, some tets left out, some turned over.
  RandomGrids() : mesh_(grid_mesh({4, 3, 3}, GetParam())) {
    std::mt19937 random(GetParam());
    for (RawLabel& label : mesh_.labels) label = kLabels[label % kLabels.size()];
    for (TetRows& tet : mesh_.tets) {
      if (random() % 2 == 0) std::swap(tet[0], tet[1]);
    }
    if (GetParam() % 2 == 0) return;
    mesh_.record.box = MeshBox{.edges = {{{4, 0, 0}, {0, 3, 0}, {0, 0, 3}}}};
    for (std::size_t i = 0; i < mesh_.tets.size(); i += 7) {
      mesh_.tets.erase(mesh_.tets.begin() + static_cast<std::ptrdiff_t>(i));
      mesh_.labels.erase(mesh_.labels.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  static constexpr std::array<RawLabel, 4> kLabels{0, 3, 1ULL << 40, ~0ULL};
  MeshData mesh_;
};

TEST_P(RandomGrids, TetsAreAllThereByLabelAndPositive) {
  const TempDir dir;
  GroupedSink sink(dir.path(), nullptr);
  GroupedMesh& mesh = grouped(sink, mesh_);
  std::vector<std::pair<RawLabel, std::set<std::uint64_t>>> expected, found;
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
    expected.emplace_back(mesh_.labels[t], std::set(mesh_.tets[t].begin(), mesh_.tets[t].end()));
  }
  std::stable_sort(expected.begin(), expected.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    for (std::uint64_t t = mesh.label_tets()[rank].begin; t < mesh.label_tets()[rank].end; ++t) {
      const TetRows tet = mesh.tet(t);
      found.emplace_back(mesh.table().raw(rank), std::set(tet.begin(), tet.end()));
      EXPECT_EQ(mesh.label_of(t), rank);
      EXPECT_GT(
          volume6_of(mesh.node(tet[0]), mesh.node(tet[1]), mesh.node(tet[2]), mesh.node(tet[3])),
          0);
    }
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(mesh.node_count(), mesh_.vertices.size());
}

TEST_P(RandomGrids, FacetsAreThoseOfBruteForce) {
  const TempDir dir;
  GroupedSink sink(dir.path(), nullptr);
  GroupedMesh& mesh = grouped(sink, mesh_);
  std::size_t left = 0;
  const std::map<Triangle, Bounds> triangles = triangles_of(mesh_);
  for (const auto& [rows, bounds] : triangles) {
    if (bounds.labels.size() == 1 || bounds.labels[0] != bounds.labels[1]) ++left;
  }
  std::uint64_t next = 0;
  for (const FacetGroup& group : mesh.facet_groups()) {
    EXPECT_EQ(group.facets.begin, next);
    next = group.facets.end;
    const RawLabel first = mesh.table().raw(group.first);
    for (std::uint64_t f = group.facets.begin; f < group.facets.end; ++f) {
      const Facet facet = mesh.facet(f);
      const Triangle rows(facet.rows.begin(), facet.rows.end());
      const Bounds& bounds = triangles.at(rows);
      const std::size_t mine = bounds.labels[0] == first ? 0 : 1;
      ASSERT_EQ(bounds.labels.at(mine), first);
      EXPECT_EQ(turned(facet.rows), bounds.turns[mine]);
      EXPECT_EQ(mesh.label_of(facet.tet), group.first);
      EXPECT_FALSE(rows.contains(mesh.tet(facet.tet)[facet.opposite]));
      if (bounds.labels.size() == 1) {
        EXPECT_EQ(group.side, side_of(mesh_, rows, {4, 3, 3}));
        EXPECT_EQ(group.second, kExterior);
      } else {
        EXPECT_EQ(group.side, Side::kInterface);
        EXPECT_EQ(mesh.table().raw(group.second), bounds.labels[1 - mine]);
        EXPECT_LT(group.first, group.second);
      }
      --left;
    }
  }
  EXPECT_EQ(left, 0U);
  EXPECT_EQ(next, mesh.facet_count());
}

TEST_P(RandomGrids, EveryEdgeHasOneMiddle) {
  const TempDir dir;
  GroupedSink sink(dir.path(), nullptr, Element::kTet10);
  GroupedMesh& mesh = grouped(sink, mesh_);
  std::map<std::set<std::uint64_t>, std::uint64_t> middle;
  for (std::uint64_t t = 0; t < mesh.tet_count(); ++t) {
    const TetRows tet = mesh.tet(t);
    const auto rows = mesh.middles(t);
    for (std::size_t e = 0; e < 6; ++e) {
      const std::set<std::uint64_t> edge{tet[kTetEdges[e][0]], tet[kTetEdges[e][1]]};
      EXPECT_EQ(middle.emplace(edge, rows[e]).first->second, rows[e]);
      const Position p = mesh.node(*edge.begin()), q = mesh.node(*edge.rbegin());
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_DOUBLE_EQ(mesh.node(rows[e])[k], (p[k] + q[k]) / 2);
      }
    }
  }
  EXPECT_EQ(mesh.node_count(), mesh.vertex_count() + middle.size());
  std::uint64_t next = mesh.vertex_count();
  for (const auto& [edge, row] : middle) EXPECT_EQ(row, next++);  // ascending by corners
  for (std::uint64_t f = 0; f < mesh.facet_count(); ++f) {
    const Facet facet = mesh.facet(f);
    const auto rows = mesh.facet_middles(facet);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(rows[i], middle.at({facet.rows[i], facet.rows[(i + 1) % 3]}));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomGrids, testing::Range(0U, 8U));

TEST(GroupedMesh, SidesOfATurnedBoxFarAway) {
  MeshData mesh = grid_mesh({3, 2, 2}, 1);
  const double c = std::cos(0.3), s = std::sin(0.3);
  const auto turn = [&](const Position& p) {
    return Position{1e4 + c * p[0] - s * p[1], -2e4 + s * p[0] + c * p[1], 3e4 + p[2]};
  };
  for (Position& p : mesh.vertices) p = turn(p);
  mesh.record.box = MeshBox{.origin = turn({0, 0, 0}),
                            .edges = {{{3 * c, 3 * s, 0}, {-2 * s, 2 * c, 0}, {0, 0, 2}}}};
  const TempDir dir;
  GroupedSink sink(dir.path(), nullptr);
  std::array<std::uint64_t, kSides> facets{};
  for (const FacetGroup& group : grouped(sink, mesh).facet_groups()) {
    facets[static_cast<std::size_t>(group.side)] += group.facets.size();
  }
  EXPECT_THAT(std::span(facets).subspan(1), testing::ElementsAre(8, 8, 12, 12, 12, 12, 0));
}

TEST(GroupedMesh, WhatIsNoMeshIsRefused) {
  const TempDir dir;
  MeshData mesh = grid_mesh({1, 1, 1}, 1);
  mesh.tets.push_back(mesh.tets.front());
  mesh.tets.push_back(mesh.tets.front());
  mesh.labels.resize(mesh.tets.size());
  GroupedSink three(dir.path(), nullptr);
  expect_error(ErrorKind::kInput, {"three tets"}, [&] { write_mesh(mesh, three); });
  mesh.tets = {{0, 1, 2, 99}};
  mesh.labels = {1};
  GroupedSink missing(dir.path(), nullptr);
  expect_error(ErrorKind::kInput, {"vertex 99"}, [&] { write_mesh(mesh, missing); });
}

TEST(GroupNames, NamesOfLabelsAreUniqueAndSidesShareOne) {
  MeshData mesh = grid_mesh({2, 2, 2}, 5);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.labels[t] = t % 4;
  mesh.names = LabelNames({{1, "liver", {}}, {2, "cyst", {}}, {3, "cyst", {}}});
  const TempDir dir;
  GroupedSink sink(dir.path(), nullptr);
  const GroupedMesh& found = grouped(sink, mesh);
  const GroupNames names(found);
  EXPECT_EQ(names.volume(0), "label_0");
  EXPECT_EQ(names.volume(1), "liver");
  EXPECT_EQ(names.volume(2), "cyst (2)");
  EXPECT_EQ(names.facets({.first = 1, .second = 3}), "liver|cyst (3)");
  EXPECT_EQ(names.facets({.side = Side::kYMax, .first = 1}), "y_max");
}

TEST(GroupNames, DifferWhateverLabelsAreCalled) {
  MeshData mesh = grid_mesh({2, 2, 2}, 5);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.labels[t] = 1 + t % 6;
  mesh.names = LabelNames(
      {{2, "label_1", {}}, {3, "x", {}}, {4, "x", {}}, {5, "x (3)", {}}, {6, "label_1|x (3)", {}}});
  const TempDir dir;
  GroupedSink sink(dir.path(), nullptr);
  const GroupedMesh& found = grouped(sink, mesh);
  const GroupNames names(found);
  EXPECT_EQ(names.volume(0), "label_1 (1)");
  EXPECT_EQ(names.volume(1), "label_1");
  EXPECT_EQ(names.volume(2), "x (3) (3)");
  EXPECT_EQ(names.volume(3), "x (4)");
  EXPECT_EQ(names.volume(4), "x (3)");
  EXPECT_EQ(names.facets({.first = 1, .second = 4}), "label_1|x (3) (2|5)");
  EXPECT_EQ(names.facets({.first = 1, .second = 3}), "label_1|x (4)");
  EXPECT_EQ(names.facets({.first = 4, .second = 5}), "x (3)|label_1|x (3) (5|6)");
}

void write_label_table(const std::filesystem::path& mesh, const LabelTable& table,
                       const LabelNames& names, const LabelNumbers& numbers) {
  AtomicFile file(label_table_path(mesh));
  append_label_table(file, table, {.names = names}, numbers);
  file.commit();
}

TEST(LabelNumbers, KeepWhatFitsAndComeBack) {
  const TempDir dir;
  const auto path = dir.path() / "m.msh";
  const std::vector<std::vector<RawLabel>> cases{
      {1, 2, 5}, {0, 1, 7}, {2147483647, 1ULL << 40, 3}, {0, ~0ULL}, {2147483647, 0, 1, 2}};
  for (const std::vector<RawLabel>& labels : cases) {
    const LabelTable table(labels, false);
    const LabelNumbers numbers(table);
    std::set<std::int64_t> seen;
    std::int64_t largest = 0;
    for (Label rank = 0; rank < table.size(); ++rank) largest = std::max(largest, numbers[rank]);
    EXPECT_EQ(numbers.largest(), largest);
    const LabelNames names({{labels[0], "a \"quoted\", name", Colour{1, 2, 3, 4}}});
    write_label_table(path, table, names, numbers);
    NumberedLabels back(path);
    for (Label rank = 0; rank < table.size(); ++rank) {
      EXPECT_TRUE(seen.insert(numbers[rank]).second);
      EXPECT_TRUE(numbers[rank] >= 1 && numbers[rank] <= 2147483647);
      const RawLabel raw = table.raw(rank);
      if (raw >= 1 && raw <= 2147483647) {
        EXPECT_EQ(static_cast<RawLabel>(numbers[rank]), raw);
      }
      EXPECT_EQ(back.label(numbers[rank]), raw);
    }
    EXPECT_FALSE(back.labels_signed());
    EXPECT_TRUE(std::ranges::equal(back.names().rows(), names.rows()));
    // It is a table of names, too.
    EXPECT_EQ(read_names(label_table_path(path)).name(labels[0]), "a \"quoted\", name");
  }
}

TEST(LabelNumbers, SignedLabelsAndNoTable) {
  const TempDir dir;
  const auto path = dir.path() / "m.msh";
  NumberedLabels none(path);
  EXPECT_EQ(none.label(7), 7U);
  EXPECT_FALSE(none.labels_signed());
  EXPECT_EQ(none.label(-7), static_cast<RawLabel>(-7));
  EXPECT_TRUE(none.labels_signed());
  const LabelTable table({static_cast<RawLabel>(-7), 4}, true);
  const LabelNumbers numbers(table);
  EXPECT_EQ(numbers[1], 4);
  write_label_table(path, table, {}, numbers);
  NumberedLabels back(path);
  EXPECT_EQ(back.label(numbers[0]), static_cast<RawLabel>(-7));
  EXPECT_TRUE(back.labels_signed());
  expect_error(ErrorKind::kInput, {"m.msh", "99"}, [&] { static_cast<void>(back.label(99)); });
}

TEST(LabelNumbers, DamagedTables) {
  const TempDir dir;
  const auto path = dir.path() / "m.inp";
  for (const char* content :
       {"", "id,number\nx,1\n", "id,number\n1\n", "id,number\n1,2\n3,2\n", "id,number\n1,\"2\n"}) {
    dir.file("m.inp.labels.csv", content);
    expect_error(ErrorKind::kInput, {"m.inp.labels.csv"}, [&] { NumberedLabels labels(path); });
  }
}

}  // namespace
}  // namespace mw::io
