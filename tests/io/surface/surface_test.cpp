// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Surfaces of labels and pairs against brute force: closed, of the label's volume, of the pair's
// triangles, and manifolds if asked for.
#include <gmock/gmock.h>

#include "tests/io/surface/collected_surface.h"

namespace mw::io {
namespace {

using Edge = std::array<std::uint64_t, 2>;
/// Corners by place, turned so that the least is first: orientation is kept.
using Corners = std::array<Position, 3>;

Corners corners_of(const CollectSurface& surface, const Triangle& triangle) {
  Corners out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = surface.vertices[triangle[i]];
  std::rotate(out.begin(), std::min_element(out.begin(), out.end()), out.end());
  return out;
}

std::multiset<Corners> junctions_of(const CollectSurface& surface) {
  std::multiset<Corners> out;
  for (const Triangle& triangle : surface.triangles) out.insert(corners_of(surface, triangle));
  return out;
}

std::map<Edge, int> directed_edges(const CollectSurface& surface) {
  std::map<Edge, int> out;
  for (const Triangle& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++out[{t[i], t[(i + 1) % 3]}];
  }
  return out;
}

/// Expects that triangles run along each edge as often one way as the other.
void expect_closed(const CollectSurface& surface) {
  const std::map<Edge, int> edges = directed_edges(surface);
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge[1], edge[0]});
    ASSERT_TRUE(back != edges.end());
    ASSERT_EQ(back->second, count);
  }
}

/// One triangle at most each way along an edge, and one fan of triangles at each vertex.
void expect_manifold(const CollectSurface& surface) {
  for (const auto& [edge, count] : directed_edges(surface)) ASSERT_EQ(count, 1);
  // Triangles at a vertex: from where to where they go around it.
  std::map<std::uint64_t, std::map<std::uint64_t, std::uint64_t>> around;
  std::map<std::uint64_t, std::set<std::uint64_t>> reached;
  for (const Triangle& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      around[t[i]][t[(i + 1) % 3]] = t[(i + 2) % 3];
      reached[t[i]].insert(t[(i + 2) % 3]);
    }
  }
  EXPECT_EQ(around.size(), surface.vertices.size()) << "a vertex without triangles";
  for (const auto& [vertex, fan] : around) {
    std::uint64_t at = fan.begin()->first;
    for (const auto& [from, to] : fan) {
      if (!reached[vertex].contains(from)) at = from;
    }
    std::size_t steps = 0;
    for (; fan.contains(at) && steps < fan.size(); ++steps) at = fan.at(at);
    ASSERT_EQ(steps, fan.size()) << "two fans at vertex " << vertex;
  }
}

double volume6(const MeshData& mesh, RawLabel label) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto at = [&](std::size_t i) { return mesh.vertices[mesh.tets[t][i]]; };
    if (mesh.labels[t] == label) sum += std::abs(volume6_of(at(0), at(1), at(2), at(3)));
  }
  return sum;
}

/// All triangles of tets, by places, with the labels on both sides.
std::map<std::set<Position>, std::vector<RawLabel>> triangles_of(const MeshData& mesh) {
  std::map<std::set<Position>, std::vector<RawLabel>> out;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::set<Position> positions;
      for (std::size_t i = 0; i < 4; ++i) {
        if (i != left_out) positions.insert(mesh.vertices[mesh.tets[t][i]]);
      }
      out[positions].push_back(mesh.labels[t]);
    }
  }
  return out;
}

std::set<std::set<Position>> unordered(const CollectSurface& surface) {
  std::set<std::set<Position>> out;
  for (const Triangle& t : surface.triangles) {
    const Corners corners = corners_of(surface, t);
    out.insert({corners.begin(), corners.end()});
  }
  EXPECT_EQ(out.size(), surface.triangles.size()) << "a triangle twice";
  return out;
}

class Surfaces : public testing::TestWithParam<unsigned> {
 protected:
  Surfaces() : data_(touching_mesh(GetParam())), mesh_(data_) {}

  [[nodiscard]] RawLabel raw(Label rank) { return mesh_.mesh().table().raw(rank); }
  [[nodiscard]] Label labels() { return static_cast<Label>(mesh_.mesh().table().size()); }

  MeshData data_;
  SurfaceMesh mesh_;
};

TEST_P(Surfaces, OfALabelIsClosedAndHasItsVolume) {
  const ShellPlans plans(mesh_.mesh(), true);
  const auto triangles = triangles_of(data_);
  for (Label rank = 0; rank < labels(); ++rank) {
    const CollectSurface surface = mesh_.collect({plans.of_label(rank)}, false);
    expect_closed(surface);
    EXPECT_DOUBLE_EQ(enclosed6(surface), volume6(data_, raw(rank)));
    // No vertex twice.
    EXPECT_EQ(std::set(surface.vertices.begin(), surface.vertices.end()).size(),
              surface.vertices.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const Corners corners = corners_of(surface, surface.triangles[t]);
      std::vector<RawLabel> sides = triangles.at({corners.begin(), corners.end()});
      const SurfaceRun& run = surface.runs[t];
      EXPECT_EQ(run.inside, rank);
      ASSERT_EQ(sides.size(), run.side == Side::kInterface ? 2U : 1U);
      sides.erase(std::find(sides.begin(), sides.end(), raw(rank)));
      if (!sides.empty()) {
        EXPECT_EQ(raw(run.outside), sides[0]);
      }
    }
  }
}

TEST_P(Surfaces, ManifoldIsAManifoldOfTheSamePlaces) {
  const ShellPlans plans(mesh_.mesh(), true);
  for (Label rank = 0; rank < labels(); ++rank) {
    const std::vector<ShellPlan> plan{plans.of_label(rank)};
    const CollectSurface plain = mesh_.collect(plan, false);
    const CollectSurface manifold = mesh_.collect(plan, true);
    expect_closed(manifold);
    expect_manifold(manifold);
    ASSERT_EQ(manifold.triangles.size(), plain.triangles.size());
    for (std::size_t t = 0; t < plain.triangles.size(); ++t) {
      EXPECT_EQ(corners_of(manifold, manifold.triangles[t]), corners_of(plain, plain.triangles[t]));
    }
    EXPECT_DOUBLE_EQ(enclosed6(manifold), volume6(data_, raw(rank)));
  }
}

/// Which of the label's tets at a vertex are reached from which through triangles there: by tet the
/// least of those.
std::map<std::size_t, std::size_t> parts_at(const MeshData& mesh, RawLabel label,
                                            std::uint64_t row) {
  std::map<std::size_t, std::size_t> part;
  std::map<std::size_t, std::set<std::uint64_t>> corners;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const std::set<std::uint64_t> here(mesh.tets[t].begin(), mesh.tets[t].end());
    if (mesh.labels[t] != label || !here.contains(row)) continue;
    part[t] = t;
    corners[t] = here;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (auto& [a, of_a] : part) {
      for (auto& [b, of_b] : part) {
        const auto& others = corners[b];
        const auto shared = std::count_if(corners[a].begin(), corners[a].end(),
                                          [&](std::uint64_t c) { return others.contains(c); });
        if (shared < 3 || of_a == of_b) continue;
        of_a = of_b = std::min(of_a, of_b);
        changed = true;
      }
    }
  }
  return part;
}

TEST_P(Surfaces, ManifoldKeepsTogetherWhatBoundsTheSameTets) {
  const ShellPlans plans(mesh_.mesh(), true);
  std::map<Position, std::uint64_t> row_at;
  for (std::uint64_t row = 0; row < data_.vertices.size(); ++row) row_at[data_.vertices[row]] = row;
  for (Label rank = 0; rank < labels(); ++rank) {
    const CollectSurface surface = mesh_.collect({plans.of_label(rank)}, true);
    std::map<std::uint64_t, std::map<std::size_t, std::size_t>> parts;
    std::map<std::uint64_t, std::size_t> part_of;  // by vertex of the surface
    for (const Triangle& triangle : surface.triangles) {
      std::set<std::uint64_t> rows;
      for (const std::uint64_t v : triangle) rows.insert(row_at.at(surface.vertices[v]));
      for (const std::uint64_t v : triangle) {
        const std::uint64_t row = row_at.at(surface.vertices[v]);
        if (!parts.contains(row)) parts[row] = parts_at(data_, raw(rank), row);
        const auto inside =
            std::find_if(parts[row].begin(), parts[row].end(), [&](const auto& tet) {
              const std::set<std::uint64_t> here(data_.tets[tet.first].begin(),
                                                 data_.tets[tet.first].end());
              return std::includes(here.begin(), here.end(), rows.begin(), rows.end());
            });
        ASSERT_TRUE(inside != parts[row].end());
        ASSERT_EQ(part_of.emplace(v, inside->second).first->second, inside->second);
      }
    }
  }
}

TEST_P(Surfaces, OpenLeavesTheBoxOutAndNothingElse) {
  const ShellPlans closed(mesh_.mesh(), true);
  const ShellPlans open(mesh_.mesh(), false);
  const Position extent{4, 3, 3};
  for (Label rank = 0; rank < labels(); ++rank) {
    std::multiset<Corners> expected = junctions_of(mesh_.collect({closed.of_label(rank)}, false));
    std::erase_if(expected, [&](const Corners& corners) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (const double plane : {0.0, extent[k]}) {
          if (std::all_of(corners.begin(), corners.end(),
                          [&](const Position& p) { return p[k] == plane; })) {
            return true;
          }
        }
      }
      return false;
    });
    EXPECT_EQ(junctions_of(mesh_.collect({open.of_label(rank)}, false)), expected);
    const CollectSurface manifold = mesh_.collect({open.of_label(rank)}, true);
    EXPECT_EQ(junctions_of(manifold), expected);
    expect_manifold(manifold);
  }
}

TEST_P(Surfaces, OfPairsAreTheTrianglesBetweenThem) {
  const ShellPlans plans(mesh_.mesh(), true);
  std::map<std::set<RawLabel>, std::set<std::set<Position>>> expected;
  for (const auto& [positions, sides] : triangles_of(data_)) {
    if (sides.size() == 2 && sides[0] != sides[1]) {
      expected[{sides.begin(), sides.end()}].insert(positions);
    }
  }
  for (Label one = 0; one < labels(); ++one) {
    for (Label other = one + 1; other < labels(); ++other) {
      const CollectSurface surface = mesh_.collect({plans.of_pair(one, other)}, false);
      EXPECT_EQ(unordered(surface), (expected[{raw(one), raw(other)}]));
      const CollectSurface turned = mesh_.collect({plans.of_pair(other, one)}, false);
      EXPECT_EQ(turned.triangles, surface.triangles);
      for (const SurfaceRun& run : surface.runs) {
        EXPECT_EQ(run.inside, one);
        EXPECT_EQ(run.outside, other);
      }
      // Turned as they are in the surface of the lower label.
      const std::multiset<Corners> all = junctions_of(mesh_.collect({plans.of_label(one)}, false));
      const std::multiset<Corners> some = junctions_of(surface);
      EXPECT_TRUE(std::includes(all.begin(), all.end(), some.begin(), some.end()));
    }
  }
}

TEST_P(Surfaces, OfInterfacesAreAllOfPairsAndWhereMeshEnds) {
  const ShellPlans plans(mesh_.mesh(), true);
  std::multiset<Corners> expected;
  for (Label one = 0; one < labels(); ++one) {
    for (Label other = one + 1; other < labels(); ++other) {
      expected.merge(junctions_of(mesh_.collect({plans.of_pair(one, other)}, false)));
    }
    const CollectSurface whole = mesh_.collect({plans.of_label(one)}, false);
    for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
      if (whole.runs[t].side == Side::kOuter) {
        expected.insert(corners_of(whole, whole.triangles[t]));
      }
    }
  }
  EXPECT_EQ(junctions_of(mesh_.collect({plans.of_interfaces()}, false)), expected);
  EXPECT_EQ(junctions_of(mesh_.collect(plans.of_each_interface(), false)), expected);
  const CollectSurface manifold = mesh_.collect(plans.of_each_interface(), true);
  EXPECT_EQ(junctions_of(manifold), expected);
  expect_manifold(manifold);
}

TEST_P(Surfaces, OfSeveralLabelsShareNoVertex) {
  const ShellPlans plans(mesh_.mesh(), true);
  const std::vector<ShellPlan> both{plans.of_label(0), plans.of_label(1)};
  for (const bool manifold : {false, true}) {
    const CollectSurface surface = mesh_.collect(both, manifold);
    std::array<std::set<std::uint64_t>, 2> vertices;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      for (const std::uint64_t v : surface.triangles[t]) vertices[surface.runs[t].inside].insert(v);
    }
    EXPECT_LT(*vertices[0].rbegin(), *vertices[1].begin());
    EXPECT_EQ(vertices[0].size() + vertices[1].size(), surface.vertices.size());
    expect_closed(surface);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Surfaces, testing::Range(0U, 24U));

/// Two tets, the second at the end of the first's edge or corner.
MeshData two_tets(std::vector<Position> more, TetRows second) {
  MeshData mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.vertices.insert(mesh.vertices.end(), more.begin(), more.end());
  mesh.tets = {{0, 1, 2, 3}, second};
  mesh.labels = {7, 7};
  return mesh;
}

TEST(ManifoldSurface, PartsTetsThatTouchInAnEdgeOrAVertex) {
  const std::vector<MeshData> meshes{
      two_tets({{-1, 0, 0}, {0, -1, 0}}, {0, 4, 5, 3}),
      two_tets({{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, {0, 5, 4, 6}),
  };
  for (const MeshData& data : meshes) {
    SurfaceMesh mesh(data);
    const ShellPlans plans(mesh.mesh(), true);
    EXPECT_EQ(mesh.collect({plans.of_label(0)}, false).vertices.size(), data.vertices.size());
    const CollectSurface parted = mesh.collect({plans.of_label(0)}, true);
    EXPECT_EQ(parted.vertices.size(), 8U);
    expect_manifold(parted);
    // Facets of one tet stay together.
    for (const Triangle& t : parted.triangles) {
      const auto tet_of = [&](std::uint64_t v) {
        const Position& p = parted.vertices[v];
        return p[0] < 0 || p[1] < 0 || p[2] < 0 ? 1 : p[0] > 0 || p[1] > 0 ? 0 : -1;
      };
      std::set<int> tets;
      for (const std::uint64_t v : t) tets.insert(tet_of(v));
      tets.erase(-1);
      EXPECT_EQ(tets.size(), 1U);
    }
  }
}

/// A ring of tets around an edge that closes on both of its ends but not along it: pairs of facets
/// that bound one fan each would share both ends of the edge.
TEST(ManifoldSurface, PartsAnEdgeWhoseFansMeetAtBothEnds) {
  bool found = false;
  for (unsigned seed = 0; seed < 200 && !found; ++seed) {
    MeshData data = grid_mesh({2, 2, 2}, seed);
    std::mt19937 random(seed);
    for (RawLabel& label : data.labels) label = random() % 2;
    SurfaceMesh mesh(data);
    const ShellPlans plans(mesh.mesh(), true);
    const CollectSurface surface = mesh.collect({plans.of_label(0)}, true);
    expect_manifold(surface);
    // Two edges between the same two places, all four ends apart, are what is left of it.
    std::map<std::set<Position>, std::set<Edge>> edges;
    for (const auto& [edge, count] : directed_edges(surface)) {
      edges[{surface.vertices[edge[0]], surface.vertices[edge[1]]}].insert(
          {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
    }
    for (const auto& [positions, same] : edges) found = found || same.size() > 1;
  }
  EXPECT_TRUE(found);
}

TEST(ManifoldSurface, SurvivesTetsWithACornerTwice) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    MeshData data = grid_mesh({2, 2, 2}, seed);
    std::mt19937 random(seed);
    for (RawLabel& label : data.labels) label = random() % 2;
    for (std::size_t t = 0; t < data.tets.size(); t += 5) {
      data.tets[t][random() % 4] = data.tets[t][random() % 4];
    }
    TempDir dir;
    GroupedSink sink(dir.path(), nullptr);
    try {
      write_mesh(data, sink);
    } catch (const Error&) {
      continue;  // three tets share a triangle
    }
    const ShellPlans plans(sink.mesh(), true);
    for (Label rank = 0; rank < sink.mesh().table().size(); ++rank) {
      CollectSurface out;
      Surface({sink.mesh(), dir.path()}, surface_labels(sink.mesh()), {plans.of_label(rank)},
              Touching::kDoubled)
          .write(out);
    }
  }
}

}  // namespace
}  // namespace mw::io
