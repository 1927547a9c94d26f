// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Interface triangles at a vertex and their edges, against maps of the whole mesh.
#include "kernels/surface/surface_star.h"

#include "kernels/simplify/simplify.h"
#include "kernels/topology/link_condition.h"
#include "tests/kernels/surface/interface_triangles.h"

namespace mw::test {
namespace {

/// (v, a, b) with its labels.
using Row = std::tuple<LocalVertex, LocalVertex, Label, Label>;

Row row_of(const SurfaceTriangle& t) {
  return {t.a, t.b, t.low, t.high};
}

Row row_of(const InterfaceTriangle& t, LocalVertex v) {
  std::array<LocalVertex, 3> c = t.corners;
  std::rotate(c.begin(), std::find(c.begin(), c.end(), v), c.end());
  return {c[1], c[2], t.low, t.high};
}

/// What a star has, whatever its order.
struct Content {
  std::set<Row> triangles;
  std::set<std::set<Row>> spokes;
  std::map<Row, Vec3> rims;
};

Content content_of(const SurfaceStar& star) {
  Content out;
  const auto& triangles = star.triangles();
  for (const SurfaceTriangle& t : triangles) EXPECT_TRUE(out.triangles.insert(row_of(t)).second);
  for (const Spoke& s : star.spokes()) {
    const SurfaceTriangle &first = triangles[s.first], &second = triangles[s.second];
    EXPECT_EQ(first.a, second.b);
    EXPECT_TRUE(out.spokes.insert({row_of(first), row_of(second)}).second);
  }
  for (const Rim& r : star.rims()) {
    EXPECT_TRUE(out.rims.emplace(row_of(triangles[r.triangle]), r.normal).second);
  }
  return out;
}

/// Edges with all tets around them loaded: each vertex of the ring is in two of those.
std::set<std::array<LocalVertex, 2>> closed_edges(const TetMesh& mesh) {
  std::map<std::array<LocalVertex, 2>, std::map<LocalVertex, int>> rings;
  for (const auto& [tet, stars] : tets_by_stars(mesh)) {
    const auto& v = tet.vertices;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) {
        for (const LocalVertex w : v) {
          if (w != v[i] && w != v[k]) ++rings[{v[i], v[k]}][w];
        }
      }
    }
  }
  std::set<std::array<LocalVertex, 2>> out;
  for (const auto& [edge, ring] : rings) {
    const bool closed =
        std::all_of(ring.begin(), ring.end(), [](auto& w) { return w.second == 2; });
    if (closed) out.insert(edge);
  }
  return out;
}

class Expected {
 public:
  Expected(const TetMesh& mesh, const Metric& metric)
      : mesh_(mesh),
        metric_(metric),
        triangles_(interface_triangles(mesh)),
        edges_(interface_edges(triangles_)),
        closed_(closed_edges(mesh)) {}

  [[nodiscard]] Content at(LocalVertex v) const {
    Content out;
    for (const InterfaceTriangle& t : triangles_) {
      if (t.has(v)) out.triangles.insert(row_of(t, v));
    }
    for (const InterfaceEdge& e : edges_) {
      const auto& [t, u] = e.triangles;
      if (e.has(v)) {
        out.spokes.insert({row_of(t, v), row_of(u, v)});
      } else if (closed_.count(e.ends) != 0) {
        if (t.has(v)) out.rims[row_of(t, v)] = u.normal(mesh_, metric_).normalized();
        if (u.has(v)) out.rims[row_of(u, v)] = t.normal(mesh_, metric_).normalized();
      }
    }
    return out;
  }

 private:
  const TetMesh& mesh_;
  const Metric& metric_;
  std::set<InterfaceTriangle> triangles_;
  std::vector<InterfaceEdge> edges_;
  std::set<std::array<LocalVertex, 2>> closed_;
};

void expect_same(const Content& found, const Content& expected) {
  EXPECT_EQ(found.triangles, expected.triangles);
  EXPECT_EQ(found.spokes, expected.spokes);
  ASSERT_EQ(found.rims.size(), expected.rims.size());
  for (const auto& [row, normal] : expected.rims) {
    ASSERT_EQ(found.rims.count(row), 1U);
    EXPECT_NEAR((found.rims.at(row) - normal).norm(), 0.0, 1e-9);
  }
}

Metric random_metric(std::mt19937& random) {
  return below(random, 2) == 0 ? Metric() : Metric({1.0, 2.0, 1.5});
}

TetMesh random_mesh(std::mt19937& random, const Metric& metric) {
  const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
  const SmallVolume volume = random_volume_of(random, kind, {5, 4, 5}, 2 + below(random, 4));
  TetMesh mesh =
      below(random, 3) == 0 ? dense_cutout(volume, {{1, 0, 1}, {5, 3, 4}}) : dense_mesh(volume);
  disturb(mesh, random);
  if (below(random, 2) == 0) simplify(mesh, metric, {.quality_floor = 0.02});
  return mesh;
}

TEST(SurfaceStar, IsThatOfAllTets) {
  std::mt19937 random(1121);
  std::size_t spokes = 0, rims = 0;
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Metric metric = random_metric(random);
    const TetMesh mesh = random_mesh(random, metric);
    const Expected expected(mesh, metric);
    SurfaceStar star;
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (!mesh.is_alive(v) || !mesh.is_free(v)) continue;
      star.collect(mesh, metric, v);
      EXPECT_TRUE(star.rims().empty());
      star.collect_rims(mesh, metric);
      ASSERT_EQ(star.vertex(), v);
      expect_same(content_of(star), expected.at(v));
      for (const SurfaceTriangle& t : star.triangles()) {
        EXPECT_EQ(t.to_a, metric.vector(mesh.position(v), mesh.position(t.a)));
        EXPECT_EQ(t.to_b, metric.vector(mesh.position(v), mesh.position(t.b)));
      }
      spokes += star.spokes().size();
      rims += star.rims().size();
    }
  }
  EXPECT_GT(spokes, 5000U);
  EXPECT_GT(rims, 5000U);
}

TEST(SurfaceStar, RimsOfSomeTrianglesAreThoseAmongAll) {
  std::mt19937 random(1122);
  std::size_t rims = 0;
  for (int i = 0; i < 20 && !HasFailure(); ++i) {
    const Metric metric = random_metric(random);
    const TetMesh mesh = random_mesh(random, metric);
    SurfaceStar all, some;
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (!mesh.is_alive(v) || !mesh.is_free(v)) continue;
      all.collect(mesh, metric, v);
      all.collect_rims(mesh, metric);
      some.collect(mesh, metric, v);
      std::vector<std::uint8_t> wanted;
      for (std::size_t k = 0; k < some.triangles().size(); ++k) {
        wanted.push_back(static_cast<std::uint8_t>(below(random, 2)));
      }
      some.collect_rims(mesh, metric, wanted);
      std::size_t found = 0;
      for (const Rim& r : all.rims()) {
        if (wanted[r.triangle] == 0) continue;
        ASSERT_LT(found, some.rims().size());
        ASSERT_EQ(some.rims()[found].triangle, r.triangle);
        ASSERT_EQ(some.rims()[found].normal, r.normal);
        ++found;
      }
      ASSERT_EQ(found, some.rims().size());
      rims += found;
    }
  }
  EXPECT_GT(rims, 1000U);
}

/// Six tets around edge (0, 1), of labels 0, 1, 2, 0, 1, 2: its triangles between 0 and 1 both run
/// through it the same way, so that they are no surface there, though they are two.
TEST(SurfaceStar, HasNoRimWhereTwoTrianglesRunTheSameWay) {
  std::vector<BlockVertex> vertices;
  for (const Point& p : {Point{9, 9, 0},
                         {9, 9, 9},
                         {18, 9, 4},
                         {13, 17, 4},
                         {5, 17, 4},
                         {0, 9, 4},
                         {5, 1, 4},
                         {13, 1, 4}}) {
    vertices.push_back({vertices.size(), {100 + p.x, 100 + p.y, 100 + p.z}, {}});
  }
  std::vector<BlockTet> tets;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const auto [a, b] = std::minmax({2 + i, 2 + (i + 1) % 6});
    tets.push_back({{0, 1, a, b}, i % 3});
  }
  std::sort(tets.begin(), tets.end());
  const TetMesh mesh(vertices, tets, {1000, 1000, 1000});
  const Metric metric;
  const Expected expected(mesh, metric);
  SurfaceStar star;
  for (LocalVertex v = 0; v < 8; ++v) {
    star.collect(mesh, metric, v);
    star.collect_rims(mesh, metric);
    EXPECT_EQ(star.triangles().size(), v < 2 ? 6U : 1U);
    EXPECT_TRUE(star.spokes().empty());
    EXPECT_TRUE(star.rims().empty());
    expect_same(content_of(star), expected.at(v));
  }
}

TEST(SurfaceStar, BendsAreThoseOfTheMovedMesh) {
  std::mt19937 random(1122);
  int moved = 0;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    const Metric metric = random_metric(random);
    TetMesh mesh = random_mesh(random, metric);
    SurfaceStar star;
    for (int k = 0; k < 10; ++k) {
      const LocalVertex v = below(random, mesh.vertex_count());
      if (!mesh.is_alive(v) || !mesh.is_free(v) || !mesh.on_interface(v)) continue;
      star.collect(mesh, metric, v);
      star.collect_rims(mesh, metric);
      const Point from = mesh.position(v);
      TetMesh after = mesh;
      const Point to{from.x + static_cast<std::int32_t>(below(random, 200)) - 100,
                     from.y + static_cast<std::int32_t>(below(random, 200)) - 100,
                     from.z + static_cast<std::int32_t>(below(random, 200)) - 100};
      after.move(v, to, mesh.quadric(v));
      // Tets may be inverted after it: the triangles are those of the mesh before.
      double expected = 0.0;
      const auto closed = closed_edges(mesh);
      for (const InterfaceEdge& e : interface_edges(interface_triangles(mesh))) {
        const bool around = e.triangles[0].has(v) || e.triangles[1].has(v);
        if (around && (e.has(v) || closed.count(e.ends) != 0)) expected += e.bend(after, metric);
      }
      EXPECT_NEAR(star.bends_at(metric.vector(from, to)), expected, 1e-9);
      ++moved;
    }
  }
  EXPECT_GT(moved, 100);
}

TEST(SurfaceStar, MergedIsThatOfTheContractedMesh) {
  std::mt19937 random(1123);
  int contracted = 0;
  for (int i = 0; i < 80 && !HasFailure(); ++i) {
    const Metric metric = random_metric(random);
    TetMesh mesh = random_mesh(random, metric);
    LinkCondition topology(mesh);
    for (int k = 0; k < 150 && !HasFailure(); ++k) {
      const auto [p, q] = random_edge(mesh, random);
      if (p == q || !mesh.on_interface(p) || !mesh.on_interface(q)) continue;
      const auto target = contraction_target(mesh, p, q, below(random, 3));
      if (!target || !stays_positive(mesh, p, q, *target)) continue;
      if (!topology.keeps_topology(mesh, p, q)) continue;
      SurfaceStar keep, drop, merged, fresh;
      keep.collect(mesh, metric, p);
      keep.collect_rims(mesh, metric);
      drop.collect(mesh, metric, q);
      drop.collect_rims(mesh, metric);
      merged.merge(keep, metric.vector(mesh.position(p), *target), drop,
                   metric.vector(mesh.position(q), *target));
      mesh.contract(p, q, *target, mesh.quadric(p));
      fresh.collect(mesh, metric, p);
      fresh.collect_rims(mesh, metric);
      EXPECT_EQ(merged.vertex(), p);
      expect_same(content_of(merged), content_of(fresh));
      const Vec3 x(0.1 * below(random, 3), -0.1, 0.1 * below(random, 3));
      EXPECT_NEAR(merged.bends_at(Vec3::Zero()), fresh.bends_at(Vec3::Zero()), 1e-9);
      EXPECT_NEAR(merged.bends_at(x), fresh.bends_at(x), 1e-9);
      ++contracted;
    }
  }
  EXPECT_GT(contracted, 300);
}

}  // namespace
}  // namespace mw::test
