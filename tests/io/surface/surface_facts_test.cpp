// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is told of triangles, against counting by brute force.
#include "io/surface/surface_facts.h"

#include "kernels/core/vector3.h"
#include "tests/io/surface/collected_surface.h"

namespace mw::io {
namespace {

/// Triangles without an order, some of which have a corner twice.
struct Soup {
  std::vector<Position> vertices;
  std::vector<Triangle> triangles;
};

Soup random_soup(unsigned seed) {
  std::mt19937 random(seed);
  Soup soup;
  const std::size_t vertices = 4 + random() % 8;
  for (std::size_t v = 0; v < vertices; ++v) {
    Position p{};
    for (double& x : p) x = static_cast<double>(random() % 3) - 1;
    if (random() % 2 == 0) p[0] = -p[0];  // 0 with both signs
    soup.vertices.push_back(p);
  }
  for (std::size_t t = 0; t < 2 + random() % 14; ++t) {
    soup.triangles.push_back({random() % vertices, random() % vertices, random() % vertices});
  }
  return soup;
}

SurfaceFacts facts_of(const Soup& soup, Joined joined) {
  const TempDir dir;
  auto labels = std::make_shared<SurfaceLabels>();
  labels->table = LabelTable({1}, false);
  labels->titles = {"a"};
  SurfaceShell shell{.label = 0, .runs = {{.outside = 0, .triangles = soup.triangles.size()}}};
  shell.vertices = soup.vertices.size();
  CollectSurface out;
  SurfaceFactsSink facts(out, joined, dir.path());
  facts.begin({.labels = labels, .shells = {shell}});
  facts.write_vertices(soup.vertices);
  facts.write_triangles(soup.triangles);
  facts.finish();
  EXPECT_EQ(out.vertices, soup.vertices);
  EXPECT_EQ(out.triangles, soup.triangles);
  return facts.facts();
}

/// Renames vertices to the first one at their place.
std::vector<Triangle> joined_triangles(const Soup& soup) {
  std::vector<Triangle> out = soup.triangles;
  for (Triangle& t : out) {
    for (std::uint64_t& v : t) {
      v = static_cast<std::uint64_t>(
          std::find(soup.vertices.begin(), soup.vertices.end(), soup.vertices[v]) -
          soup.vertices.begin());
    }
  }
  return out;
}

/// The number of parts of the triangles at a vertex that edges at the vertex join.
std::size_t parts_at(const std::vector<Triangle>& triangles, std::uint64_t vertex) {
  std::vector<std::set<std::uint64_t>> parts;
  for (const Triangle& t : triangles) {
    std::set<std::uint64_t> ends(t.begin(), t.end());
    if (ends.size() < 3 || ends.erase(vertex) == 0) continue;
    for (auto part = parts.begin(); part != parts.end();) {
      const bool meets = std::any_of(ends.begin(), ends.end(),
                                     [&](std::uint64_t end) { return part->contains(end); });
      if (meets) ends.insert(part->begin(), part->end());
      part = meets ? parts.erase(part) : part + 1;
    }
    parts.push_back(ends);
  }
  return parts.size();
}

SurfaceFacts brute_force(const std::vector<Triangle>& triangles, std::size_t vertices) {
  SurfaceFacts out{.triangles = triangles.size()};
  const auto count = [&](std::uint64_t from, std::uint64_t to) {
    std::size_t found = 0;
    for (const Triangle& t : triangles) {
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        if (t[i] == from && t[(i + 1) % 3] == to) ++found;
      }
    }
    return found;
  };
  for (std::uint64_t a = 0; a < vertices; ++a) {
    if (parts_at(triangles, a) > 1) ++out.pinched_vertices;
    for (std::uint64_t b = 0; b < a; ++b) {
      if (count(a, b) != count(b, a)) ++out.open_edges;
      if (std::max(count(a, b), count(b, a)) > 1) ++out.crowded_edges;
    }
  }
  return out;
}

TEST(SurfaceFactsOfSoups, AreWhatCountingFinds) {
  std::array<std::size_t, 3> seen{};
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Soup soup = random_soup(seed);
    for (const Joined joined : {Joined::kByNumber, Joined::kByPlace}) {
      const SurfaceFacts found = facts_of(soup, joined);
      const std::vector<Triangle> triangles =
          joined == Joined::kByPlace ? joined_triangles(soup) : soup.triangles;
      const SurfaceFacts expected = brute_force(triangles, soup.vertices.size());
      EXPECT_EQ(found.triangles, expected.triangles);
      EXPECT_EQ(found.open_edges, expected.open_edges);
      EXPECT_EQ(found.crowded_edges, expected.crowded_edges);
      EXPECT_EQ(found.pinched_vertices, expected.pinched_vertices);
      seen[0] += expected.open_edges;
      seen[1] += expected.crowded_edges;
      seen[2] += expected.pinched_vertices;
    }
  }
  for (const std::size_t count : seen) EXPECT_GT(count, 50U);
}

TEST(SurfaceFactsOfLabels, AreClosedAndHaveTheVolumeOfTheirTets) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const MeshData data = touching_mesh(seed);
    SurfaceMesh mesh(data);
    const ShellPlans plans(mesh.mesh(), true);
    for (Label rank = 0; rank < mesh.mesh().table().size(); ++rank) {
      const TempDir dir;
      CollectSurface out;
      SurfaceFactsSink facts(out, Joined::kByNumber, dir.path());
      mesh.surface({plans.of_label(rank)}, Touching::kDoubled).write(facts);
      EXPECT_TRUE(facts.facts().is_closed() && facts.facts().is_manifold());
      double volume = 0;
      for (std::size_t t = 0; t < data.tets.size(); ++t) {
        const auto at = [&](std::size_t i) { return data.vertices[data.tets[t][i]]; };
        if (data.labels[t] != mesh.mesh().table().raw(rank)) continue;
        volume += std::abs(volume6(at(0), at(1), at(2), at(3))) / 6;
      }
      EXPECT_NEAR(facts.facts().volume / volume, 1, 1e-12);
    }
  }
}

/// Terms of 1e18 cancel, beside which a plain sum loses the volume of a small box.
TEST(SurfaceFactsOfSoups, VolumesAreNotLostBesideLargeTerms) {
  Soup soup;
  soup.vertices = {{0, 0, 0},   {1, 0, 0},   {0, 1, 0},  {0, 0, 1},
                   {1e6, 0, 0}, {0, 1e6, 1}, {1, 1, 1e6}};
  const std::vector<Triangle> tet{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  soup.triangles = {{4, 5, 6}};
  soup.triangles.insert(soup.triangles.end(), tet.begin(), tet.end());
  soup.triangles.push_back({4, 6, 5});
  EXPECT_DOUBLE_EQ(facts_of(soup, Joined::kByNumber).volume, 1.0 / 6);
}

}  // namespace
}  // namespace mw::io
