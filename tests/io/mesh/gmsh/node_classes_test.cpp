// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Entities of nodes against a search of all facets and tets.
#include "io/mesh/gmsh/node_classes.h"

#include <set>

#include "io/mesh/grouped/grouped_sink.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

/// Rows of each entity's elements, entities as NodeClasses numbers them.
std::vector<std::set<std::uint64_t>> rows_by_entity(GroupedMesh& mesh) {
  const bool ten = mesh.element() == Element::kTet10;
  std::vector<std::set<std::uint64_t>> out;
  for (const FacetGroup& group : mesh.facet_groups()) {
    std::set<std::uint64_t>& rows = out.emplace_back();
    for (std::uint64_t f = group.facets.begin; f < group.facets.end; ++f) {
      const Facet facet = mesh.facet(f);
      for (const std::uint64_t row : facet.rows) rows.insert(row);
      if (!ten) continue;
      for (const std::uint64_t row : mesh.facet_middles(facet)) rows.insert(row);
    }
  }
  for (const RowRange& tets : mesh.label_tets()) {
    std::set<std::uint64_t>& rows = out.emplace_back();
    for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
      for (const std::uint64_t row : mesh.tet(t)) rows.insert(row);
      if (!ten) continue;
      for (const std::uint64_t row : mesh.middles(t)) rows.insert(row);
    }
  }
  return out;
}

class NodeClassesOfGrids : public testing::TestWithParam<std::tuple<unsigned, Element>> {
 protected:
  NodeClassesOfGrids()
      : mesh_(grid_mesh({4, 3, 3}, std::get<0>(GetParam()))),
        sink_(dir_.path(), nullptr, std::get<1>(GetParam())) {
    // Nodes of no tet, at the beginning, in the middle and at the end.
    mesh_.vertices.push_back({-9, -9, -9});
    std::erase_if(mesh_.tets, [&](const TetRows& tet) {
      return std::ranges::count(tet, 0U) + std::ranges::count(tet, 30U) > 0;
    });
    mesh_.labels.resize(mesh_.tets.size());
    write_mesh(mesh_, sink_);
  }

  TempDir dir_;
  MeshData mesh_;
  GroupedSink sink_;
};

TEST_P(NodeClassesOfGrids, EveryNodeIsOnTheFirstEntityThatHasIt) {
  GroupedMesh& mesh = sink_.mesh();
  NodeClasses classes(mesh, dir_.path());
  const std::vector<std::set<std::uint64_t>> rows = rows_by_entity(mesh);
  ASSERT_EQ(classes.entities(), rows.size());
  std::uint64_t next = 0;
  std::set<std::uint64_t> seen;
  for (std::size_t e = 0; e < rows.size(); ++e) {
    std::vector<std::uint64_t> expected, found;
    for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
      const auto has = [&](const auto& of_entity) { return of_entity.contains(row); };
      const auto first = std::find_if(rows.begin(), rows.end(), has);
      const std::size_t entity = first == rows.end()
                                     ? mesh.facet_groups().size()
                                     : static_cast<std::size_t>(first - rows.begin());
      if (entity == e) expected.push_back(row);
    }
    const RowRange& indices = classes.nodes(e);
    if (indices.size() > 0) {
      EXPECT_EQ(indices.begin, next);
      next = indices.end;
    }
    for (std::uint64_t i = indices.begin; i < indices.end; ++i) found.push_back(classes.row(i));
    EXPECT_EQ(found, expected) << e;
  }
  EXPECT_EQ(next, mesh.node_count());
}

TEST_P(NodeClassesOfGrids, BoxesAreThoseOfAllNodes) {
  GroupedMesh& mesh = sink_.mesh();
  const NodeClasses classes(mesh, dir_.path());
  const std::vector<std::set<std::uint64_t>> rows = rows_by_entity(mesh);
  for (std::size_t e = 0; e < rows.size(); ++e) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::set<double> on_axis;
      for (const std::uint64_t row : rows[e]) on_axis.insert(mesh.node(row)[k]);
      EXPECT_EQ(classes.box(e).lo[k], *on_axis.begin());
      EXPECT_EQ(classes.box(e).hi[k], *on_axis.rbegin());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, NodeClassesOfGrids,
                         testing::Combine(testing::Range(0U, 6U),
                                          testing::Values(Element::kTet4, Element::kTet10)));

}  // namespace
}  // namespace mw::io
