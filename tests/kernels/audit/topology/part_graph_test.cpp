// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Components of a graph without each class, against one flood fill a class.
#include "kernels/audit/topology/part_graph.h"
#include "kernels/audit/topology/junctions.h"
#include "kernels/core/error.h"
#include "tests/oracle/cell_complex.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_junctions.h"
#include "tests/testing.h"

namespace mw::audit {
namespace {

using namespace test;

struct Graph {
  std::vector<Label> part_class;
  std::vector<PartPair> pairs;
};

Graph random_graph(std::mt19937& random, std::uint32_t classes) {
  Graph graph;
  const std::uint32_t parts = 1 + below(random, 30);
  for (std::uint32_t p = 0; p < parts; ++p) graph.part_class.push_back(below(random, classes));
  std::sort(graph.part_class.begin(), graph.part_class.end());
  for (std::uint32_t e = below(random, 40); e > 0; --e) {
    const std::uint32_t a = below(random, parts), b = below(random, parts);
    if (a != b) graph.pairs.push_back({std::min(a, b), std::max(a, b)});
  }
  return graph;
}

/// Components of the parts for which keep(part), by repeated spreading of the least number.
template <class Keep>
std::int64_t flood(const Graph& graph, Keep&& keep) {
  std::vector<std::uint32_t> min;
  for (std::uint32_t p = 0; p < graph.part_class.size(); ++p) min.push_back(p);
  for (std::size_t round = 0; round < min.size(); ++round) {
    for (const PartPair& e : graph.pairs) {
      if (keep(e.a) && keep(e.b)) min[e.a] = min[e.b] = std::min(min[e.a], min[e.b]);
    }
  }
  std::set<std::uint32_t> found;
  for (std::uint32_t p = 0; p < min.size(); ++p) {
    if (keep(p)) found.insert(min[p]);
  }
  return static_cast<std::int64_t>(found.size());
}

TEST(PartGraph, ComponentsWithoutAndWithinEachClass) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 1000; ++trial) {
    const std::uint32_t classes = 1 + below(random, 9);
    const Graph graph = random_graph(random, classes);
    const auto without = components_without(graph.part_class, graph.pairs, classes);
    const auto within = components_within(graph.part_class, graph.pairs, classes);
    for (Label c = 0; c < classes; ++c) {
      const auto inside = [&](std::uint32_t p) { return graph.part_class[p] == c; };
      ASSERT_EQ(without[c], flood(graph, [&](std::uint32_t p) { return !inside(p); }));
      ASSERT_EQ(within[c], flood(graph, inside));
    }
  }
}

TEST(PartGraph, ComponentsWithoutEachGroupOfPairs) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 1000; ++trial) {
    const std::uint32_t groups = 1 + below(random, 9);
    const Graph graph = random_graph(random, 3);
    std::vector<GroupedPair> pairs;
    for (const PartPair& p : graph.pairs) {
      pairs.push_back({p, below(random, groups), below(random, groups)});
    }
    const auto components = components_leaving_out(graph.part_class.size(), pairs, groups);
    ASSERT_EQ(components.size(), groups);
    for (std::uint32_t g = 0; g < groups; ++g) {
      Graph rest{graph.part_class, {}};
      for (const GroupedPair& p : pairs) {
        if (p.group != g && p.other_group != g) rest.pairs.push_back(p.parts);
      }
      ASSERT_EQ(components[g], flood(rest, [](std::uint32_t) { return true; }));
    }
  }
}

TEST(PartGraph, PartsOfAVertexStayConnectedWithoutAnyClass) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 500; ++trial) {
    Graph graph = random_graph(random, 6);
    std::vector<std::uint32_t> all;
    for (std::uint32_t p = 0; p < graph.part_class.size(); ++p) all.push_back(p);
    PartGraph meeting;
    meeting.add_vertex(all, graph.part_class);
    graph.pairs = meeting.take_vertex_pairs();
    ASSERT_LT(graph.pairs.size(), 2 * all.size());
    for (Label c = 0; c < 6; ++c) {
      ASSERT_LE(flood(graph, [&](std::uint32_t p) { return graph.part_class[p] != c; }), 1);
      ASSERT_LE(flood(graph, [&](std::uint32_t p) { return graph.part_class[p] == c; }), 1);
    }
  }
}

TEST(PartGraph, PairSetKeepsEveryPairOnce) {
  std::mt19937 random(11);
  PairSet set;
  std::set<PartPair> expected;
  for (int i = 0; i < 3'000'000; ++i) {
    const std::uint32_t a = below(random, 1500), b = below(random, 1500);
    set.add(a, b);
    if (a != b) expected.insert({std::min(a, b), std::max(a, b)});
  }
  EXPECT_EQ(set.take(), std::vector<PartPair>(expected.begin(), expected.end()));
  EXPECT_TRUE(set.take().empty());
}

// Betti numbers of meetings and interfaces against ranks of boundary matrices.

BettiOfJunctions by_set(const std::vector<JunctionBetti>& junctions) {
  BettiOfJunctions out;
  for (const JunctionBetti& p : junctions) {
    std::set<Label> labels(p.labels.begin(), p.labels.end());
    labels.erase(kNoLabel);
    EXPECT_TRUE(out.emplace(labels, p.betti).second);
  }
  return out;
}

void expect_equal(const Places& junctions, const JunctionsBetti& oracle, const std::string& text) {
  EXPECT_TRUE(by_set(junctions.interfaces) == oracle.interfaces) << text;
  EXPECT_TRUE(by_set(junctions.meetings) == oracle.meetings) << text;
}

/// Volumes and five-tet meshes, and meshes whose tets bear any labels.
TEST(Places, AreThoseOfTheOracle) {
  std::mt19937 random(21);
  std::size_t cavities = 0, tunnels = 0;
  for (int trial = 0; trial < 400 && !HasFailure(); ++trial) {
    const SmallVolume v = random_volume(random);
    SmallMesh mesh = five_tet_mesh(v);
    const Places junctions = junctions_of_volume(v.view(), v.label_count);
    expect_equal(junctions, junctions_of(complex_of(v.view(), v.label_count)), v.text());
    expect_equal(junctions_of_mesh(mesh.view(), v.label_count),
                 junctions_of(complex_of(mesh.view(), v.label_count)), v.text());
    for (Label& l : mesh.labels) {
      if (below(random, 8) == 0) l = below(random, static_cast<std::uint32_t>(v.label_count));
    }
    expect_equal(junctions_of_mesh(mesh.view(), v.label_count),
                 junctions_of(complex_of(mesh.view(), v.label_count)), v.text());
    for (const JunctionBetti& p : junctions.interfaces) {
      cavities += p.betti.b2 > 0 ? 1 : 0;
      tunnels += p.betti.b1 > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(cavities, 100U);
  EXPECT_GT(tunnels, 100U);
}

TEST(Places, AreThoseOfTheOracleForManyLabels) {
  std::mt19937 random(22);
  for (int trial = 0; trial < 40 && !HasFailure(); ++trial) {
    const SmallVolume v = random_volume_of(random, VolumeKind::kNoise, {3, 4, 3}, 12);
    expect_equal(junctions_of_volume(v.view(), v.label_count),
                 junctions_of(complex_of(v.view(), v.label_count)), v.text());
    const SmallMesh mesh = five_tet_mesh(v);
    expect_equal(junctions_of_mesh(mesh.view(), v.label_count),
                 junctions_of(complex_of(mesh.view(), v.label_count)), v.text());
  }
}

/// Two voxels that share an edge meet there, with no interface; the exterior wraps everything.
TEST(Places, ContactThroughAnEdgeIsAMeetingButNoInterface) {
  const SmallVolume v =
      volume_from({2, 2, 1}, 3, [](auto x, auto y, auto) { return x != y ? 0 : 1 + x; });
  const Places junctions = junctions_of_volume(v.view(), 3);
  const JunctionLabels one_two{1, 2, kNoLabel, kNoLabel};
  const auto is = [&](const JunctionBetti& p) { return p.labels == one_two; };
  EXPECT_EQ(std::count_if(junctions.interfaces.begin(), junctions.interfaces.end(), is), 0);
  const auto met = std::find_if(junctions.meetings.begin(), junctions.meetings.end(), is);
  ASSERT_NE(met, junctions.meetings.end());
  EXPECT_EQ(met->betti, (Betti{1, 0, 0}));
}

TEST(Places, RefuseUnsoundInput) {
  const std::vector<Label> labels{0, 1};
  EXPECT_THROW((void)junctions_of_volume({{1, 1, 1}, labels}, 2), Error);
  const std::vector<Position> vertices(4);
  const std::vector<TetRow> tets{{0, 1, 2, 4}};
  EXPECT_THROW((void)junctions_of_mesh({vertices, tets, std::span(labels).first(1)}, 1), Error);
}

}  // namespace
}  // namespace mw::audit
