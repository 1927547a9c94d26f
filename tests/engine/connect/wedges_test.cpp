// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Wedges between the sides of interfaces of random meshes, against all pairs of facets that lie at
// one place.
#include "io/mesh/grouped/grouped_sink.h"
#include "kernels/core/error.h"
#include "kernels/core/vector3.h"
#include "tests/engine/connect/random_mesh.h"
#include "tests/testing.h"

namespace mw::engine {
namespace {

using namespace test;

using FacetPlace = std::array<io::Position, 3>;  ///< ascending

/// A facet of a tet.
struct Face {
  std::size_t tet = 0;
  std::set<std::uint64_t> rows;
  std::uint64_t opposite = 0;  ///< row of the corner that it does not have
};

std::map<FacetPlace, std::vector<Face>> faces_by_place(const io::MeshData& mesh) {
  std::map<FacetPlace, std::vector<Face>> out;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      Face face{.tet = t, .rows = {}, .opposite = mesh.tets[t][left_out]};
      FacetPlace place{};
      for (std::size_t i = 0, k = 0; i < 4; ++i) {
        if (i == left_out) continue;
        face.rows.insert(mesh.tets[t][i]);
        place[k++] = mesh.vertices[mesh.tets[t][i]];
      }
      std::sort(place.begin(), place.end());
      out[place].push_back(face);
    }
  }
  return out;
}

/// Returns how many facets should open by the rule, and how many of them have not.
std::array<std::uint64_t, 2> facets_to_open(const io::MeshData& mesh, const SplitRule& rule) {
  std::array<std::uint64_t, 2> out{};
  for (const auto& [place, faces] : faces_by_place(mesh)) {
    if (faces.size() != 2) continue;
    if (!rule.cuts(mesh.labels[faces[0].tet], mesh.labels[faces[1].tet])) continue;
    ++out[0];
    out[1] += faces[0].rows == faces[1].rows ? 1U : 0U;
  }
  return out;
}

/// By place of the facet: the face under the wedge, and the one on top of it.
struct Expected {
  std::map<FacetPlace, std::array<Face, 2>> wedges;
  std::uint64_t closed = 0;
};

Expected expected_wedges(const io::MeshData& mesh, const io::CohesiveRule& rule) {
  Expected out;
  for (const auto& [place, faces] : faces_by_place(mesh)) {
    if (faces.size() != 2) continue;
    std::array<Face, 2> pair{faces[0], faces[1]};
    const auto label = [&](std::size_t side) { return mesh.labels[pair[side].tet]; };
    if (label(0) > label(1)) std::swap(pair[0], pair[1]);
    bool has_wedge = rule.all && label(0) != label(1);
    for (const auto& named : rule.pairs) {
      if (named == std::array{label(1), label(0)}) std::swap(pair[0], pair[1]);
      has_wedge = has_wedge || named == std::array{label(0), label(1)};
    }
    if (!has_wedge) continue;
    if (pair[0].rows == pair[1].rows) {
      ++out.closed;
    } else {
      out.wedges[place] = pair;
    }
  }
  return out;
}

io::GroupedSink& group(const io::MeshData& mesh, io::GroupedSink& sink) {
  io::write_mesh(mesh, sink);
  return sink;
}

ConnectOptions random_options(unsigned seed) {
  ConnectOptions options;
  if (seed % 4 == 0) options.cohesive.all = true;
  if (seed % 4 == 1) options.cohesive.pairs = {{2, 1}};
  if (seed % 4 == 2) options.cohesive.pairs = {{1, 2}, {3, 1}};
  if (seed % 4 == 3) {
    options.cohesive.pairs = {{2, 3}};
    options.split.pairs = {{1, 2}};
  }
  options.open_hinges = seed % 3 == 0;
  if (seed % 5 == 0) options.parts.only_largest = true;
  return options;
}

TEST(Wedges, AreThoseOfAllFacetsThatOpen) {
  std::size_t wedges = 0, rims = 0, closed = 0, held = 0;
  for (unsigned seed = 0; seed < 160; ++seed) {
    SCOPED_TRACE(seed);
    const io::MeshData made = random_mesh(seed);
    if (made.tets.empty()) continue;
    const ConnectOptions options = random_options(seed);
    const auto [mesh, facts] = connect(made, options);
    EXPECT_EQ(mesh.record.cohesive, options.cohesive);
    const Expected expected = expected_wedges(mesh, options.cohesive);
    EXPECT_EQ(facts.wedges, expected.wedges.size());
    EXPECT_EQ(facts.closed, expected.closed);
    closed += facts.closed;
    EXPECT_EQ((std::array{facts.facets, facts.held}), facets_to_open(mesh, options.all_split()));
    held += facts.held - facts.closed;
    const ::mw::test::TempFolder folder;
    io::GroupedSink sink(folder.path(), nullptr);
    io::GroupedMesh& grouped = group(mesh, sink).mesh();
    ASSERT_EQ(grouped.wedge_count(), expected.wedges.size());
    std::set<FacetPlace> seen;
    std::uint64_t next = 0;
    for (const io::WedgeGroup& of : grouped.wedge_groups()) {
      EXPECT_EQ(of.wedges.begin, next);
      EXPECT_GT(of.wedges.size(), 0U);
      next = of.wedges.end;
      for (std::uint64_t w = of.wedges.begin; w < of.wedges.end; ++w) {
        const io::Wedge wedge = grouped.wedge(w);
        FacetPlace place{};
        std::size_t shared = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          place[i] = mesh.vertices.at(wedge.bottom[i]);
          EXPECT_EQ(place[i], mesh.vertices.at(wedge.top[i])) << "it has no thickness";
          shared += wedge.bottom[i] == wedge.top[i] ? 1U : 0U;
        }
        EXPECT_LT(shared, 3U);
        rims += shared > 0 ? 1U : 0U;
        const FacetPlace corners = place;
        std::sort(place.begin(), place.end());
        EXPECT_TRUE(seen.insert(place).second);
        ASSERT_TRUE(expected.wedges.contains(place));
        const auto& [under, above] = expected.wedges.at(place);
        EXPECT_EQ(std::set(wedge.bottom.begin(), wedge.bottom.end()), under.rows);
        EXPECT_EQ(std::set(wedge.top.begin(), wedge.top.end()), above.rows);
        EXPECT_EQ(grouped.table().raw(of.bottom), mesh.labels[under.tet]);
        EXPECT_EQ(grouped.table().raw(of.top), mesh.labels[above.tet]);
        EXPECT_EQ(grouped.label_of(wedge.bottom_tet), of.bottom);
        EXPECT_EQ(grouped.label_of(wedge.top_tet), of.top);
        const auto side_of = [&](const Face& face) {
          return volume6(corners[0], corners[1], corners[2], mesh.vertices[face.opposite]);
        };
        EXPECT_LT(side_of(under), 0) << "the normal points away from the tet under it";
        EXPECT_GT(side_of(above), 0);
        ++wedges;
      }
    }
    EXPECT_EQ(next, grouped.wedge_count());
  }
  EXPECT_GT(std::min(wedges, rims), 100U);
  EXPECT_GT(closed, 5U);
  EXPECT_GT(held, 2U);
}

/// Nodes in the middles of edges are those that the tets on both sides have.
TEST(Wedges, OfTenNodesHaveTheMiddlesOfTheirTets) {
  std::size_t wedges = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    const io::MeshData made = random_mesh(seed);
    if (made.tets.empty()) continue;
    const io::MeshData mesh = connect(made, random_options(seed)).mesh;
    const ::mw::test::TempFolder folder;
    io::GroupedSink sink(folder.path(), nullptr, io::Element::kTet10);
    io::GroupedMesh& grouped = group(mesh, sink).mesh();
    for (std::uint64_t w = 0; w < grouped.wedge_count(); ++w, ++wedges) {
      const io::Wedge wedge = grouped.wedge(w);
      const io::NodeRows rows = grouped.wedge_nodes(wedge);
      ASSERT_EQ(rows.size(), 12U);
      const std::span<const std::uint64_t> nodes(rows.begin(), rows.end());
      for (std::size_t side = 0; side < 2; ++side) {
        const io::NodeRows of_tet = grouped.tet_nodes(side == 0 ? wedge.bottom_tet : wedge.top_tet);
        for (std::size_t i = 0; i < 3; ++i) {
          const std::uint64_t from = nodes[3 * side + i], to = nodes[3 * side + (i + 1) % 3];
          const std::uint64_t middle = nodes[6 + 3 * side + i];
          EXPECT_NE(std::find(of_tet.begin() + 4, of_tet.end(), middle), of_tet.end());
          const io::Position p = grouped.node(from), q = grouped.node(to);
          const io::Position m = grouped.node(middle);
          for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(m[k], p[k] + (q[k] - p[k]) / 2);
        }
      }
    }
  }
  EXPECT_GT(wedges, 100U);
}

/// Merged by position there is nothing between the sides any more.
TEST(Wedges, AreNoneWhereNoVertexIsDoubled) {
  io::MeshData mesh = random_mesh(3);
  mesh.record.cohesive.all = true;
  const ::mw::test::TempFolder folder;
  io::GroupedSink sink(folder.path(), nullptr);
  EXPECT_EQ(group(mesh, sink).mesh().wedge_count(), 0U);
}

TEST(ConnectOptions, OfCohesiveInterfaces) {
  const io::CohesiveRule rule = parse_cohesive("3|1,2|3");
  EXPECT_EQ(rule.pairs, (std::vector<std::array<RawLabel, 2>>{{2, 3}, {3, 1}}));
  EXPECT_TRUE(rule.has(1, 3) && rule.has(3, 1) && rule.names(3, 1));
  EXPECT_FALSE(rule.names(1, 3) || rule.has(1, 2) || rule.has(1, 1));
  EXPECT_TRUE(parse_cohesive("*").has(1, 2));
  EXPECT_FALSE(parse_cohesive("*").has(1, 1));
  for (const char* text : {"", "1", "1|1", "1|2,", "1|2,2|1", "1|2,1|2"}) {
    EXPECT_THROW(static_cast<void>(parse_cohesive(text)), Error) << text;
  }
  const ConnectOptions options{.split = parse_split("5|4"), .cohesive = rule};
  EXPECT_TRUE(options.change_mesh());
  EXPECT_TRUE(options.all_split().cuts(1, 3) && options.all_split().cuts(4, 5));
  EXPECT_FALSE(options.all_split().cuts(1, 2));
  EXPECT_THROW(check_interfaces(options, io::LabelTable({1, 2, 4, 5}, false)), Error);
  EXPECT_THROW(check_interfaces(options, io::LabelTable({1, 2, 3, 4}, false)), Error);
  check_interfaces(options, io::LabelTable({1, 2, 3, 4, 5}, false));
}

}  // namespace
}  // namespace mw::engine
