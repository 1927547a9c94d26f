// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Flips: same region, same labels seen from outside, better shapes, and an end to them.
#include "kernels/optimise/flips.h"

#include "kernels/optimise/optimise.h"
#include "kernels/quality/quality.h"
#include "kernels/simplify/simplify.h"
#include "tests/kernels/mesh/dense_mesh.h"
#include "tests/kernels/surface/interface_triangles.h"

namespace mw::test {
namespace {

/// Virtual tets included.
std::set<TetKey> tet_keys(const TetMesh& mesh) {
  std::set<TetKey> out;
  for (const auto& [key, stars] : tets_by_stars(mesh)) out.insert(key);
  return out;
}

/// What is in the first only.
std::vector<LocalTet> missing(const std::set<TetKey>& from, const std::set<TetKey>& in) {
  std::vector<LocalTet> out;
  for (const TetKey& key : from) {
    if (in.count(key) == 0) out.push_back(positive(key));
  }
  return out;
}

using Face = std::array<LocalVertex, 3>;

/// Directed faces of tets that no other of the tets has the other way round, with the label inside:
/// the region's surface.
std::map<Face, Label> surface(const std::vector<LocalTet>& tets) {
  const auto rotated = [](Face f) {
    std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    return f;
  };
  std::map<Face, Label> out;
  for (const LocalTet& t : tets) {
    const auto [a, b, c, d] = t.vertices;
    for (const Face& f : {Face{b, c, d}, {a, d, c}, {a, b, d}, {a, c, b}}) {
      if (out.erase(rotated({f[0], f[2], f[1]})) == 0) out.emplace(rotated(f), t.label);
    }
  }
  return out;
}

std::set<Label> labels_of(const std::vector<LocalTet>& tets) {
  std::set<Label> out;
  for (const LocalTet& t : tets) out.insert(t.label);
  return out;
}

constexpr double kFloor = 0.1;

/// Measures of the real tets, all of which are positive.
struct Measures {
  std::int64_t volume6 = 0;
  double worst = 1.0;   ///< least radius ratio
  double energy = 0.0;  ///< sum of 1 / radius ratio
};

Measures measure(const TetMesh& mesh, const Metric& metric, const std::vector<LocalTet>& tets) {
  Measures out;
  for (const LocalTet& t : tets) {
    if (t.label == kExterior) continue;
    EXPECT_GT(volume6_of(mesh, t), 0);
    const double r = radius_ratio(mesh, metric, t);
    out.volume6 += volume6_of(mesh, t);
    out.worst = std::min(out.worst, r);
    out.energy += 1.0 / r;
  }
  return out;
}

/// The old tets and the new ones fill the same region, look the same from outside, label by label,
/// and the new ones are better: less energy, and none bad where there was none before.
void expect_sound(const TetMesh& mesh, const Metric& metric, const std::vector<LocalTet>& gone,
                  const std::vector<LocalTet>& added) {
  const Measures before = measure(mesh, metric, gone), after = measure(mesh, metric, added);
  EXPECT_EQ(before.volume6, after.volume6);
  EXPECT_LT(after.energy, before.energy);
  EXPECT_GE(after.worst, std::min(before.worst, 0.3));
  EXPECT_TRUE(surface(gone) == surface(added));
  EXPECT_EQ(labels_of(gone), labels_of(added));
  EXPECT_LE(labels_of(gone).size(), 2U);
}

/// A mesh with bad tets, whole or cut out.
TetMesh bad_mesh(std::mt19937& random, std::uint32_t labels) {
  const auto kind = below(random, 2) == 0 ? VolumeKind::kBlobs : VolumeKind::kSpecks;
  const SmallVolume volume = random_volume_of(random, kind, {5, 5, 5}, labels);
  TetMesh mesh =
      below(random, 2) == 0 ? dense_mesh(volume) : dense_cutout(volume, {{0, 1, 1}, {5, 5, 4}});
  simplify(mesh, Metric(), {.quality_floor = 0.0});
  disturb(mesh, random);
  return mesh;
}

/// Tries a random edge.
bool random_flip(const TetMesh& mesh, Flipper& flipper, std::mt19937& random) {
  const auto tets = mesh.tets();
  const auto& v = tets[below(random, static_cast<std::uint32_t>(tets.size()))].vertices;
  const std::size_t i = below(random, 4), j = (i + 1 + below(random, 3)) % 4;
  return flipper.remove_edge(v[i], v[j]);
}

TEST(Flips, FillTheSameRegionWithBetterTets) {
  std::mt19937 random(801);
  int flips = 0, surface_flips = 0;
  for (int i = 0; i < 150 && !HasFailure(); ++i) {
    const Metric metric = i % 3 == 0 ? Metric({1.0, 2.0, 3.0}) : Metric();
    TetMesh mesh = bad_mesh(random, 1 + below(random, 3));
    Flipper flipper(mesh, metric, kFloor);
    std::set<TetKey> before = tet_keys(mesh);
    for (int k = 0; k < 150; ++k) {
      const bool flipped = random_flip(mesh, flipper, random);
      std::set<TetKey> after = tet_keys(mesh);
      ASSERT_EQ(flipped, after != before);
      if (!flipped) continue;
      const auto gone = missing(before, after);
      expect_sound(mesh, metric, gone, missing(after, before));
      surface_flips += labels_of(gone).size() == 2 ? 1 : 0;
      before = std::move(after);
      ++flips;
    }
    for (const auto& [key, stars] : tets_by_stars(mesh)) {
      ASSERT_EQ(stars, key.label == kExterior ? 3 : 4);
    }
  }
  EXPECT_GT(flips, 300);
  EXPECT_GT(surface_flips, 100);
}

/// Every edge of the mesh once; number of flips.
int flip_everywhere(TetMesh& mesh, const Metric& metric) {
  Flipper flipper(mesh, metric, kFloor);
  int flips = 0;
  for (const LocalTet& t : mesh.tets()) {
    const auto& v = t.vertices;
    const auto is_there = [&] {
      const auto star = mesh.star(v[0]);
      return std::any_of(star.begin(), star.end(), [&](const LinkTriangle& u) {
        return u.has(v[1]) && u.has(v[2]) && u.has(v[3]) && u.label != kExterior;
      });
    };
    for (const auto& [p, q] : {std::pair(v[0], v[1]),
                               {v[0], v[2]},
                               {v[0], v[3]},
                               {v[1], v[2]},
                               {v[2], v[3]},
                               {v[3], v[1]}}) {
      if (is_there()) flips += flipper.remove_edge(p, q) ? 1 : 0;
    }
  }
  return flips;
}

/// Symmetric configurations have flips that change nothing but the last bits of a radius ratio;
/// taken for gains, they went back and forth for ever.
TEST(Flips, EndOnSymmetricLattices) {
  for (const std::int64_t edge : {2, 3, 4, 6}) {
    for (const auto& spacing : {std::array{1.0, 1.0, 1.0}, {1.0, 1.0, 2.0}, {3.0, 2.0, 1.0}}) {
      const Metric metric(spacing);
      TetMesh mesh =
          dense_mesh(volume_from({edge, edge, edge}, 1, [](auto, auto, auto) { return 0; }));
      int sweeps = 0;
      while (flip_everywhere(mesh, metric) > 0) ASSERT_LT(++sweeps, 50);
    }
  }
}

/// Four tets around edge (0, 1) of an octahedron that is its own mirror image when x and y change
/// places; that image has edge (2, 3) in its middle, with the same four radius ratios up to the
/// last bits.
TetMesh symmetric_octahedron(std::mt19937& random) {
  const auto about = [&](std::int32_t centre) {
    return centre + static_cast<std::int32_t>(below(random, 601)) - 300;
  };
  const auto mirrored = [](Point p) { return Point{p.y, p.x, p.z}; };
  const Point p{about(1800), about(1000), about(1000)}, q{about(200), about(1000), about(1000)};
  const std::int32_t top = about(1000), bottom = about(1000);
  const std::array<Point, 6> corners{
      {p, q, mirrored(p), mirrored(q), {top, top, about(2000)}, {bottom, bottom, about(0)}}};
  std::vector<BlockVertex> vertices;
  for (const Point& x : corners) {
    vertices.push_back({vertices.size(), {x.x + 5000, x.y + 5000, x.z + 5000}, {}});
  }
  const std::array<BlockTet, 4> tets{
      {{{0, 1, 2, 4}, 0}, {{0, 1, 2, 5}, 0}, {{0, 1, 3, 4}, 0}, {{0, 1, 3, 5}, 0}}};
  return {vertices, tets, {1 << 30, 1 << 30, 1 << 30}};
}

TEST(Flips, EndOnSymmetricOctahedra) {
  std::mt19937 random(803);
  const Metric metric;
  for (int i = 0; i < 3000; ++i) {
    TetMesh mesh = symmetric_octahedron(random);
    Flipper flipper(mesh, metric, kFloor);
    int flips = 0;
    for (int sweep = 0; sweep < 10; ++sweep) {
      for (LocalVertex axis = 0; axis < 6; axis += 2) {
        flips += flipper.remove_edge(axis, axis + 1) ? 1 : 0;
      }
    }
    ASSERT_LE(flips, 2);
  }
}

TEST(Flips, EndAfterSimplification) {
  std::mt19937 random(802);
  for (int i = 0; i < 60; ++i) {
    const Metric metric = i % 2 == 0 ? Metric() : Metric({1.0, 2.0, 1.0});
    TetMesh mesh = dense_mesh(
        volume_from({6, 5, 4}, 2, [&](auto x, auto, auto) { return x < i % 6 ? 1 : 0; }));
    simplify(mesh, metric, {.quality_floor = 0.05});
    int sweeps = 0;
    while (flip_everywhere(mesh, metric) > 0) ASSERT_LT(++sweeps, 50);
  }
}

/// A mesh with bad tets of a small volume with two or three labels, whose topology is known.
struct KnownMesh {
  SmallVolume volume;
  GuardedMesh guarded;
  std::vector<RegionBetti> expected;

  explicit KnownMesh(std::mt19937& random)
      : volume(random_volume_of(random,
                                below(random, 2) == 0 ? VolumeKind::kBlobs : VolumeKind::kSpecks,
                                {5, 5, 5}, 2 + below(random, 2))),
        guarded(volume, 3.0),
        expected(betti(volume)) {
    if (below(random, 3) != 0) simplify(guarded.mesh, {}, {.quality_floor = 0.0}, &guarded.guard);
    disturb(guarded.mesh, random);
  }

  void expect_kept() const {
    for (const LocalTet& t : guarded.mesh.tets()) ASSERT_GT(volume6_of(guarded.mesh, t), 0);
    ASSERT_TRUE(betti(guarded.mesh, volume.label_count) == expected);
  }
};

/// True if the edge lies between two labels, one of which has a single tet there.
bool has_cap(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
  std::map<Label, int> tets;
  for (const LinkTriangle& t : mesh.star(p)) {
    if (t.has(q)) ++tets[t.label];
  }
  const auto is_one = [](const auto& count) { return count.second == 1; };
  return tets.size() == 2 && std::any_of(tets.begin(), tets.end(), is_one);
}

/// However much the surface gains, a flip of an interface edge keeps the topology of all labels,
/// also where it takes the only tet that a label has there.
TEST(Flips, OfInterfaceEdgesKeepTopology) {
  std::mt19937 random(804);
  constexpr double kAlways = 1e6;
  const Metric metric;
  int flips = 0, caps = 0, refused_caps = 0;
  InterfaceFan fans;
  std::vector<FanTriangle> fan;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    KnownMesh known(random);
    TetMesh& mesh = known.guarded.mesh;
    Flipper flipper(mesh, metric, 0.0, &known.guarded.guard);
    for (LocalVertex v = 0; v < mesh.vertex_count() && !HasFailure(); ++v) {
      if (!mesh.is_alive(v)) continue;
      fans.collect(mesh, v, fan);
      for (const FanTriangle& t : fan) {
        const bool cap = has_cap(mesh, v, t.a), flipped = flipper.flip_surface(v, t.a, kAlways);
        flips += flipped ? 1 : 0;
        (flipped ? caps : refused_caps) += cap ? 1 : 0;
        if (!flipped) continue;
        known.expect_kept();
        break;
      }
    }
  }
  EXPECT_GT(flips, 200);
  EXPECT_GT(caps, 20);
  EXPECT_GT(refused_caps, 20);
}

/// Gives up to six tets of a vertex's star label 1, most of them beside each other, the others
/// label 0, and some tets of the mesh either one.  Returns the vertex, which is off the box.
LocalVertex draw_labels(TetMesh& mesh, std::mt19937& random) {
  LocalVertex v = 0;
  do {
    v = below(random, mesh.vertex_count());
  } while (!mesh.is_alive(v) || mesh.planes(v) != 0);
  const std::vector<LinkTriangle> star(mesh.star(v).begin(), mesh.star(v).end());
  for (const LinkTriangle& t : star) {
    const LinkTriangle u = mesh.star(t.a)[below(random, 3)];
    if (u.label == kExterior) continue;
    mesh.relabel({{t.a, u.a, u.b, u.c}, 0}, below(random, 4) == 0 ? 0 : 1);
  }
  for (const LinkTriangle& t : star) mesh.relabel({{v, t.a, t.b, t.c}, 0}, 0);
  std::vector<LinkTriangle> drawn;
  for (std::uint32_t tries = 1 + below(random, 12); tries != 0 && drawn.size() < 6; --tries) {
    const LinkTriangle t = star[below(random, static_cast<std::uint32_t>(star.size()))];
    const bool beside = std::any_of(drawn.begin(), drawn.end(), [&](const LinkTriangle& u) {
      return int{u.has(t.a)} + int{u.has(t.b)} + int{u.has(t.c)} == 2;
    });
    if (drawn.empty() || beside || below(random, 4) == 0) drawn.push_back(t);
  }
  for (const LinkTriangle& t : drawn) mesh.relabel({{v, t.a, t.b, t.c}, 0}, 1);
  return v;
}

/// Whether each edge at the star's vertex that has interface triangles has two of them.
bool has_two_at_each_edge(const SurfaceStar& star) {
  return !star.triangles().empty() && star.spokes().size() == star.triangles().size();
}

/// A dimple that goes leaves its vertex inside the other label, and the topology as it is.
TEST(Flips, OfDimplesKeepTopology) {
  std::mt19937 random(805);
  const Metric metric;
  std::array<int, 5> flips{};
  SurfaceStar star;
  TetMesh mesh = KnownMesh(random).guarded.mesh;
  for (const LocalTet& t : mesh.tets()) mesh.relabel(t, below(random, 4) == 0 ? 0 : 1);
  Flipper flipper(mesh, metric, 0.0);
  for (int i = 0; i < 5000 && !HasFailure(); ++i) {
    const LocalVertex v = draw_labels(mesh, random);
    if (mesh.order(v) != 2) continue;
    star.collect(mesh, metric, v);
    if (!has_two_at_each_edge(star)) continue;
    const std::size_t tets = flipper.find_dimple(v, star.fan()).size();
    if (tets == 0) continue;
    const std::vector<RegionBetti> before = betti(mesh, 2);
    ASSERT_TRUE(flipper.flip_dimple(v, star.fan()));
    ++flips.at(tets);
    EXPECT_EQ(mesh.order(v), 1);
    ASSERT_TRUE(betti(mesh, 2) == before) << tets << " tets";
    for (const auto& [key, stars] : tets_by_stars(mesh)) {
      ASSERT_EQ(stars, key.label == kExterior ? 3 : 4);
    }
  }
  for (std::size_t tets = 1; tets < flips.size(); ++tets) EXPECT_GT(flips[tets], 10) << tets;
}

/// The mesh of 2^3 voxels with a vertex more in the middle of one tet; it is the last one.
BlockMesh block_with_split_tet(std::size_t row) {
  BlockMesh block = dense_block(volume_from({2, 2, 2}, 1, [](auto, auto, auto) { return 0; }),
                                {{0, 0, 0}, {2, 2, 2}});
  const auto corners = block.tets[row].vertices;
  Point middle;
  for (const auto v : corners) {
    middle.x += block.vertices[v].position.x / 4;
    middle.y += block.vertices[v].position.y / 4;
    middle.z += block.vertices[v].position.z / 4;
  }
  const auto w = static_cast<LocalVertex>(block.vertices.size());
  block.vertices.push_back({block.vertices.back().id + 1, middle, {}});
  block.tets.erase(block.tets.begin() + static_cast<std::ptrdiff_t>(row));
  for (std::size_t i = 0; i < 4; ++i) {
    BlockTet part{corners, 0};
    part.vertices[i] = w;
    std::sort(part.vertices.begin(), part.vertices.end());
    block.tets.push_back(part);
  }
  return block;
}

/// Three tets around an edge and a fourth one elsewhere at the same vertex have six interface
/// triangles, as many as four tets in a row, but they are two parts: a handle would vanish.
TEST(Flips, LeaveADimpleOfTwoParts) {
  const Metric metric;
  SurfaceStar star;
  constexpr std::size_t kRows = 40;
  int pairs = 0;
  for (std::size_t row = 0; row < kRows; ++row) {
    const BlockMesh block = block_with_split_tet(row);
    TetMesh mesh(block.vertices, block.tets, far_corner({2, 2, 2}));
    const LocalVertex w = mesh.vertex_count() - 1;
    for (const LinkTriangle& corner : std::vector(mesh.star(w).begin(), mesh.star(w).end())) {
      const LocalVertex v = corner.a;
      if (mesh.planes(v) != 0) continue;
      for (const LocalTet& t : mesh.tets()) mesh.relabel(t, has(t, v) && !has(t, w) ? 0 : 1);
      const std::vector<LinkTriangle> others(mesh.star(v).begin(), mesh.star(v).end());
      for (const LinkTriangle& t : others) {
        if (t.has(w)) continue;
        mesh.relabel({{v, t.a, t.b, t.c}, 0}, 1);
        star.collect(mesh, metric, v);
        if (has_two_at_each_edge(star) && star.triangles().size() == 6) {
          EXPECT_TRUE(Flipper(mesh, metric, 0.0).find_dimple(v, star.fan()).empty());
          ++pairs;
        }
        mesh.relabel({{v, t.a, t.b, t.c}, 1}, 0);
      }
    }
  }
  EXPECT_GT(pairs, 5);
}

}  // namespace
}  // namespace mw::test
