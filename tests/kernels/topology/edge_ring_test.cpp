// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rings around edges against a search over all tets, on whole and on partly loaded meshes.
#include "kernels/topology/edge_ring.h"

#include <gtest/gtest.h>

#include "kernels/quality/mesh_quality.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

bool has_vertex(const TetKey& t, LocalVertex v) {
  return std::find(t.vertices.begin(), t.vertices.end(), v) != t.vertices.end();
}

/// All tets at an edge, virtual ones included.
std::set<TetKey> tets_at(const std::map<TetKey, int>& all, LocalVertex p, LocalVertex q) {
  std::set<TetKey> out;
  for (const auto& [t, stars] : all) {
    if (has_vertex(t, p) && has_vertex(t, q)) out.insert(t);
  }
  return out;
}

/// Each vertex of the ring is in two of its tets.  (In part of a cycle, which is all that can be
/// loaded, that makes it the whole cycle.)
bool closes(const std::set<TetKey>& ring, LocalVertex p, LocalVertex q) {
  std::map<LocalVertex, int> count;
  for (const TetKey& t : ring) {
    for (LocalVertex v : t.vertices) count[v] += v != p && v != q ? 1 : 0;
  }
  return std::all_of(count.begin(), count.end(), [&](const auto& entry) {
    return entry.first == p || entry.first == q || entry.second == 2;
  });
}

void expect_ring(const EdgeRing& ring, LocalVertex p, LocalVertex q,
                 const std::set<TetKey>& expected) {
  std::set<TetKey> actual;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    EXPECT_EQ(ring.ends[i], ring.vertices[(i + 1) % ring.size()]);
    actual.insert(tet_key({{p, q, ring.vertices[i], ring.ends[i]}, ring.labels[i]}));
  }
  EXPECT_TRUE(actual == expected);
  EXPECT_EQ(ring.size(), expected.size());
}

TEST(EdgeRing, IsTheCycleOfAllTetsAtTheEdgeOrRefused) {
  std::mt19937 random(311);
  int whole = 0, partial = 0;
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const SmallVolume volume = random_volume(random);
    BlockMesh block = dense_block(volume, {{0, 0, 0}, volume.shape});
    std::erase_if(block.tets,
                  [&](const BlockTet&) { return i % 2 != 0 && below(random, 12) == 0; });
    const TetMesh mesh(block.vertices, block.tets, far_corner(volume.shape));
    const auto all = tets_by_stars(mesh);
    EdgeRing ring;
    for (int k = 0; k < 40; ++k) {
      const LocalVertex p = below(random, mesh.vertex_count());
      if (mesh.star(p).empty()) continue;
      const LocalVertex q =
          mesh.star(p)[below(random, static_cast<std::uint32_t>(mesh.star(p).size()))].a;
      if (q == mesh.infinity()) continue;
      const auto expected = tets_at(all, p, q);
      const bool found = collect_ring(mesh, p, q, ring);
      ASSERT_EQ(found, closes(expected, p, q));
      if (found) expect_ring(ring, p, q, expected);
      (found ? whole : partial) += 1;
    }
  }
  EXPECT_GT(whole, 500);
  EXPECT_GT(partial, 100);
}

/// Every edge of every vertex whose star is whole; the first vertices have the numbers of labels.
TEST(EdgeRing, TetsInAnyOrderAreAllOfTheRing) {
  std::mt19937 random(312);
  std::size_t edges = 0, several_words = 0;
  for (int i = 0; i < 20 && !HasFailure(); ++i) {
    const TetMesh mesh = dense_mesh(random_volume(random));
    const auto all = tets_by_stars(mesh);
    EdgeRing ring;
    for (LocalVertex p = 0; p < mesh.vertex_count(); ++p) {
      if (!mesh.is_free(p)) continue;
      several_words += mesh.star(p).size() > 16 ? 1U : 0U;
      for (const LinkTriangle& t : mesh.star(p)) {
        if (t.a == mesh.infinity()) continue;
        collect_ring_tets(mesh, p, t.a, ring);
        std::set<TetKey> tets;
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const LocalTet tet{{p, t.a, ring.vertices[k], ring.ends[k]}, ring.labels[k]};
          tets.insert(tet_key(tet));
          EXPECT_TRUE(tet.label == kExterior || is_positive(mesh, tet));
        }
        ASSERT_EQ(ring.size(), tets.size());
        ASSERT_TRUE(tets == tets_at(all, p, t.a));
        ++edges;
      }
    }
  }
  EXPECT_GT(edges, 5000U);
  EXPECT_GT(several_words, 200U);
}

TEST(EdgeRing, VerticesWithoutAnEdgeHaveNone) {
  const TetMesh mesh = dense_mesh(volume_from({3, 3, 3}, 1, [](auto, auto, auto) { return 0; }));
  EdgeRing ring;
  EXPECT_FALSE(collect_ring(mesh, 0, mesh.vertex_count() - 1, ring));
  collect_ring_tets(mesh, 0, mesh.vertex_count() - 1, ring);
  EXPECT_EQ(ring.size(), 0U);
}

}  // namespace
}  // namespace mw::test
