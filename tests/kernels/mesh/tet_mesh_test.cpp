// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// TetMesh: stars, freedom and edits against lists of tets.
#include "kernels/mesh/tet_mesh.h"
#include "kernels/mesh/failed_pairs.h"
#include "kernels/topology/link_condition.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

using Directed = std::array<LocalVertex, 3>;

/// Returns the triangle in the same cyclic order with its smallest vertex first.
Directed rotated(Directed t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// Directed faces of all tets, and how often each occurs.
std::map<Directed, int> directed_faces(const std::map<TetKey, int>& tets) {
  std::map<Directed, int> out;
  for (const auto& [key, stars] : tets) {
    const auto [a, b, c, d] = positive(key).vertices;
    for (const Directed& face : {Directed{b, c, d}, {a, d, c}, {a, b, d}, {a, c, b}}) {
      ++out[rotated(face)];
    }
  }
  return out;
}

void expect_consistent_stars(const TetMesh& mesh) {
  for (const auto& [key, stars] : tets_by_stars(mesh)) {
    const bool is_virtual = key.vertices[3] == mesh.infinity();
    ASSERT_EQ(stars, is_virtual ? 3 : 4);
    ASSERT_EQ(is_virtual, key.label == kExterior);
    const auto& v = key.vertices;
    if (is_virtual) {
      ASSERT_NE(mesh.planes(v[0]) & mesh.planes(v[1]) & mesh.planes(v[2]), 0);
    } else {
      ASSERT_GT(volume6_of(mesh, positive(key)), 0);
    }
  }
}

/// Every directed triangle occurs once, and once the other way round: the mesh and the virtual tets
/// are a closed complex.
void expect_closed(const TetMesh& mesh) {
  const auto faces = directed_faces(tets_by_stars(mesh));
  for (const auto& [face, count] : faces) {
    ASSERT_EQ(count, 1);
    ASSERT_EQ(faces.count(rotated({face[0], face[2], face[1]})), 1U);
  }
}

TEST(TetMesh, StarsOfAStartMeshAreConsistentAndClosed) {
  std::mt19937 random(401);
  for (int i = 0; i < 100 && !HasFatalFailure(); ++i) {
    const SmallVolume volume = random_volume(random);
    const TetMesh mesh = dense_mesh(volume);
    expect_consistent_stars(mesh);
    expect_closed(mesh);
    EXPECT_EQ(mesh.tets().size(), volume.labels.size() * 5);
  }
}

/// Some tets of a start mesh, at random.
TetMesh random_part(const SmallVolume& volume, std::mt19937& random, std::uint32_t lost_of_16) {
  BlockMesh block = dense_block(volume, {{0, 0, 0}, volume.shape});
  std::erase_if(block.tets, [&](const BlockTet&) { return below(random, 16) < lost_of_16; });
  return {block.vertices, block.tets, far_corner(volume.shape)};
}

/// Brute force: each edge of the link is in exactly two of its triangles.
bool link_is_closed(const TetMesh& mesh, LocalVertex v) {
  std::map<std::pair<LocalVertex, LocalVertex>, int> edges;
  for (const LinkTriangle& t : mesh.star(v)) {
    ++edges[std::minmax(t.a, t.b)];
    ++edges[std::minmax(t.b, t.c)];
    ++edges[std::minmax(t.c, t.a)];
  }
  return !edges.empty() && std::all_of(edges.begin(), edges.end(),
                                       [](const auto& entry) { return entry.second == 2; });
}

TEST(Sec41FreeVertices, AreThoseWhoseStarIsLoadedWhole) {
  std::mt19937 random(402);
  int free = 0, fixed = 0;
  for (std::uint32_t i = 0; i < 200 && !HasFailure(); ++i) {
    const TetMesh mesh = random_part(random_volume(random), random, 1 + i % 3);
    expect_consistent_stars(mesh);
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      const bool expected = link_is_closed(mesh, v);
      ASSERT_EQ(mesh.is_free(v), expected);
      (expected ? free : fixed) += 1;
    }
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(fixed, 1000);
}

TEST(Sec41FreeVertices, OfACutoutAreThoseOffItsInnerPlanes) {
  const SmallVolume volume = volume_from({6, 6, 6}, 1, [](auto, auto, auto) { return 0; });
  const Box3 window{{0, 2, 1}, {4, 6, 6}};
  const TetMesh mesh = dense_cutout(volume, window);
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    const Point p = mesh.position(v);
    const bool cut =
        p.x == 4 * kUnitsPerVoxel || p.y == 2 * kUnitsPerVoxel || p.z == 1 * kUnitsPerVoxel;
    EXPECT_EQ(mesh.is_free(v), !cut);
  }
}

using StarKey = std::vector<std::pair<Directed, Label>>;

StarKey star_key(const TetMesh& mesh, LocalVertex v) {
  StarKey key;
  for (const LinkTriangle& t : mesh.star(v)) key.push_back({rotated({t.a, t.b, t.c}), t.label});
  std::sort(key.begin(), key.end());
  return key;
}

TetMesh rebuilt(const TetMesh& mesh, const std::vector<LocalTet>& tets, Point box) {
  std::vector<BlockVertex> vertices;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) vertices.push_back(mesh.vertex(v));
  std::vector<BlockTet> block_tets;
  for (const LocalTet& t : tets) block_tets.push_back({tet_key(t).vertices, t.label});
  std::sort(block_tets.begin(), block_tets.end());
  return {vertices, block_tets, box};
}

void expect_same_mesh(const TetMesh& actual, const TetMesh& expected) {
  for (LocalVertex v = 0; v < actual.vertex_count(); ++v) {
    ASSERT_TRUE(star_key(actual, v) == star_key(expected, v));
    ASSERT_EQ(actual.is_alive(v), expected.is_alive(v));
    if (!actual.is_alive(v)) continue;
    ASSERT_EQ(actual.is_free(v), expected.is_free(v));
    ASSERT_EQ(actual.planes(v), expected.planes(v));
    ASSERT_EQ(actual.order(v), expected.order(v));
    ASSERT_EQ(actual.label_signature(v), expected.label_signature(v));
    ASSERT_EQ(actual.on_interface(v), expected.on_interface(v));
  }
}

TEST(TetMesh, ContractingEqualsRebuildingFromTheContractedTets) {
  std::mt19937 random(403);
  int contractions = 0;
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const SmallVolume volume = random_volume(random);
    TetMesh mesh = i % 3 == 0 ? random_part(volume, random, 1) : dense_mesh(volume);
    disturb(mesh, random);
    LinkCondition topology(mesh);
    for (int k = 0; k < 60; ++k) {
      const auto [p, q] = random_edge(mesh, random);
      if (p == q) continue;
      const auto x = contraction_target(mesh, p, q, below(random, 3));
      if (!x || !stays_positive(mesh, p, q, *x) || !topology.keeps_topology(mesh, p, q)) continue;
      // A vertex goes where its planes allow; the one on more planes must survive.
      const bool keep_p = (mesh.planes(p) & mesh.planes(q)) == mesh.planes(q);
      const LocalVertex keep = keep_p ? p : q, drop = keep_p ? q : p;
      const auto tets = contracted(mesh.tets(), keep, drop);
      const std::uint32_t version = mesh.version(keep);
      const Quadric quadric = mesh.quadric(p) + mesh.quadric(q);
      mesh.contract(keep, drop, *x, quadric);
      expect_same_mesh(mesh, rebuilt(mesh, tets, far_corner(volume.shape)));
      EXPECT_NE(mesh.version(keep), version);
      EXPECT_EQ(mesh.position(keep), *x);
      EXPECT_EQ(mesh.quadric(keep), quadric);
      EXPECT_FALSE(mesh.is_alive(drop));
      ++contractions;
    }
  }
  EXPECT_GT(contractions, 500);
}

TEST(TetMesh, AddingUndoesRemoving) {
  std::mt19937 random(404);
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    const SmallVolume volume = random_volume(random);
    TetMesh mesh = dense_mesh(volume);
    const TetMesh before = mesh;
    const std::vector<LocalTet> tets = mesh.tets();
    std::vector<LocalTet> removed;
    std::set<TetKey> expected;
    for (LocalTet t : tets) {
      if (below(random, 3) != 0) {
        expected.insert(tet_key(t));
        continue;
      }
      // Any naming of a tet finds it: here an even permutation.
      std::swap(t.vertices[0], t.vertices[1]);
      std::swap(t.vertices[2], t.vertices[3]);
      mesh.remove_tet(t);
      removed.insert(removed.begin(), t);
    }
    std::set<TetKey> left;
    for (const LocalTet& t : mesh.tets()) left.insert(tet_key(t));
    ASSERT_TRUE(left == expected);
    for (const LocalTet& t : removed) mesh.add_tet(t);
    expect_same_mesh(mesh, before);
    expect_consistent_stars(mesh);
  }
}

void expect_orders_of_its_tets(const TetMesh& mesh) {
  std::vector<std::set<Label>> labels(mesh.vertex_count());
  for (const LocalTet& t : mesh.tets()) {
    for (LocalVertex v : t.vertices) labels[v].insert(t.label);
  }
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(mesh.on_interface(v), labels[v].size() > 1);
    if (mesh.planes(v) != 0) labels[v].insert(kExterior);
    EXPECT_EQ(mesh.order(v), static_cast<int>(labels[v].size()));
    std::uint64_t signature = 0;
    for (Label l : labels[v]) signature |= mesh.label_bit(l);
    EXPECT_EQ(mesh.label_signature(v), signature);
  }
}

/// Also after tets got other labels.
TEST(Sec531Order, CountsTheDistinctLabelsAtAVertex) {
  std::mt19937 random(405);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    TetMesh mesh = dense_mesh(random_volume_of(random, VolumeKind::kNoise, {3, 4, 3}, 7));
    expect_orders_of_its_tets(mesh);
    const std::vector<LocalTet> tets = mesh.tets();
    for (std::size_t k = 0; k < tets.size(); k += 7) {
      mesh.relabel(tets[k], tets[below(random, static_cast<std::uint32_t>(tets.size()))].label);
    }
    expect_orders_of_its_tets(mesh);
  }
}

TEST(TetMesh, PlanesAreThoseOfTheBox) {
  const SmallVolume volume = volume_from({2, 3, 4}, 1, [](auto, auto, auto) { return 0; });
  const TetMesh mesh = dense_mesh(volume);
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    const Point p = mesh.position(v), far = far_corner(volume.shape);
    const unsigned expected = (p.x == 0 ? 1U : 0U) | (p.x == far.x ? 2U : 0U) |
                              (p.y == 0 ? 4U : 0U) | (p.y == far.y ? 8U : 0U) |
                              (p.z == 0 ? 16U : 0U) | (p.z == far.z ? 32U : 0U);
    EXPECT_EQ(mesh.planes(v), expected);
  }
}

TEST(TetMesh, EitherPlaneOfAnAxisFixesTheAxis) {
  for (unsigned planes = 0; planes < 64; ++planes) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const bool on_plane = (planes >> (2 * axis) & 3U) != 0;
      EXPECT_EQ((fixed_axes(static_cast<BoxPlanes>(planes)) >> axis & 1U) != 0, on_plane);
    }
  }
}

/// After contractions and moves: each real tet once, vertices and tets ascending.
TEST(TetMesh, SortedTetsAreTheTetsInOrder) {
  std::mt19937 random(411);
  int contracted = 0;
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const SmallVolume volume = random_volume(random);
    TetMesh mesh = i % 3 == 0 ? random_part(volume, random, 4) : dense_mesh(volume);
    for (int k = 0; k < 20; ++k) {
      const auto [p, q] = random_edge(mesh, random);
      if (p == q || !stays_positive(mesh, p, q, mesh.position(p))) continue;
      if (contraction_target(mesh, p, q, 0) == std::nullopt) continue;
      mesh.contract(p, q, mesh.position(p), mesh.quadric(p));
      ++contracted;
    }
    std::vector<BlockTet> expected;
    for (const LocalTet& t : mesh.tets()) {
      expected.push_back({t.vertices, t.label});
      std::ranges::sort(expected.back().vertices);
    }
    std::ranges::sort(expected);
    EXPECT_EQ(mesh.sorted_tets(), expected);
  }
  EXPECT_GT(contracted, 100);
}

TEST(TetMesh, TellsTheIdsOfItsVertices) {
  const SmallVolume volume = volume_from({2, 3, 2}, 1, [](auto, auto, auto) { return 0; });
  const BlockMesh block = dense_block(volume, {{0, 1, 0}, {2, 3, 2}});
  const TetMesh mesh(block.vertices, block.tets, far_corner(volume.shape));
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(mesh.id(v), block.vertices[v].id);
    EXPECT_EQ(mesh.vertex(v), block.vertices[v]);
  }
}

// Failed edges are remembered, from both ends, until one of these changes.

/// The memo may lose entries, but never has one that was not made.
TEST(FailedPairs, HoldNothingThatWasNotInserted) {
  std::mt19937 random(421);
  const SmallVolume volume = volume_from({6, 6, 6}, 1, [](auto, auto, auto) { return 0; });
  TetMesh mesh = dense_mesh(volume);
  FailedPairs failed(mesh.vertex_count());
  std::set<std::array<std::uint32_t, 4>> inserted;
  const auto entry = [&](LocalVertex p, LocalVertex q) {
    if (p > q) std::swap(p, q);
    return std::array<std::uint32_t, 4>{p, q, mesh.version(p), mesh.version(q)};
  };
  int kept = 0, forgotten_by_moves = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto [p, q] = random_edge(mesh, random);
    if (p == q) continue;
    if (failed.contains(mesh, p, q)) {
      ASSERT_EQ(inserted.count(entry(p, q)), 1U);
      ASSERT_TRUE(failed.contains(mesh, q, p));
      ++kept;
    }
    inserted.insert(entry(p, q));
    failed.insert(mesh, q, p);
    ASSERT_TRUE(failed.contains(mesh, p, q));
    if (i % 5 != 0) continue;
    mesh.move(p, mesh.position(p), mesh.quadric(p));
    ASSERT_FALSE(failed.contains(mesh, p, q));
    ++forgotten_by_moves;
  }
  EXPECT_GT(kept, 500);
  EXPECT_GT(forgotten_by_moves, 500);
}

TEST(FailedPairs, AreOfSomeSizeWhateverTheMesh) {
  const SmallVolume volume = volume_from({1, 1, 1}, 1, [](auto, auto, auto) { return 0; });
  const TetMesh mesh = dense_mesh(volume);
  FailedPairs failed(0);
  failed.insert(mesh, 0, 1);
  EXPECT_TRUE(failed.contains(mesh, 1, 0));
  EXPECT_FALSE(failed.contains(mesh, 0, 2));
}

/// A plane that the mesh goes through has no virtual tets, sides beyond it, and vertices that are
/// free where both sides are loaded; it counts once in their order, as the exterior would.
TEST(TetMesh, PlanesInsideHaveSides) {
  std::mt19937 random(417);
  std::size_t free_in_plane = 0;
  for (int i = 0; i < 60 && !HasFatalFailure(); ++i) {
    const Index3 shape{4, 2 + below(random, 3), 2 + below(random, 3)};
    const SmallVolume volume = random_volume_of(random, random_kind(random), shape, 3);
    const BlockMesh block = dense_block(volume, {{0, 0, 0}, shape});
    Point box = far_corner(shape);
    box.x = 2 * kUnitsPerVoxel;
    const TetMesh mesh(block.vertices, block.tets, box, BoxPlanes{2}),
        plain(block.vertices, block.tets, far_corner(shape));
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      const bool in_plane = mesh.position(v).x == box.x;
      ASSERT_EQ((mesh.planes(v) & 2U) != 0, in_plane);
      for (const LinkTriangle& t : mesh.star(v)) {
        if (t.label == kExterior) continue;
        const bool beyond = mesh.position(v).x > box.x || mesh.position(t.a).x > box.x ||
                            mesh.position(t.b).x > box.x || mesh.position(t.c).x > box.x;
        ASSERT_EQ(side_of(t.label), beyond ? side_beyond(0) : 0U);
      }
      if (!in_plane) continue;
      ASSERT_EQ(mesh.is_free(v), plain.is_free(v));
      const int labels = plain.order(v) - (plain.planes(v) != 0 ? 1 : 0);
      ASSERT_EQ(mesh.order(v), labels + 1);
      ASSERT_EQ(mesh.on_interface(v), labels > 1);
      ++free_in_plane;
    }
  }
  EXPECT_GT(free_in_plane, 500U);
}

}  // namespace
}  // namespace mw::test
