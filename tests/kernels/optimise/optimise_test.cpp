// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Smoothing and whole sweeps: nothing gets worse, nothing leaves its place, and they end.
#include "kernels/optimise/optimise.h"

#include <algorithm>
#include <array>

#include "kernels/optimise/smooth.h"
#include "kernels/optimise/unfold.h"
#include "kernels/quality/quality.h"
#include "kernels/simplify/simplify.h"
#include "tests/kernels/mesh/dense_mesh.h"
#include "tests/kernels/optimise/short_cost.h"
#include "tests/kernels/surface/interface_triangles.h"

namespace mw::test {
namespace {

TetMesh random_mesh(std::mt19937& random, const Metric& metric, const SmallVolume& volume) {
  TetMesh mesh =
      below(random, 2) == 0 ? dense_mesh(volume) : dense_cutout(volume, {{1, 0, 1}, {5, 4, 5}});
  if (below(random, 3) != 0) simplify(mesh, metric, {.quality_floor = 0.05});
  disturb(mesh, random);
  return mesh;
}

SmallVolume random_five(std::mt19937& random) {
  const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
  return random_volume_of(random, kind, {5, 5, 5}, 1 + below(random, 4));
}

constexpr SmoothOptions kOptions{.smooth_below = 1.0, .quality_floor = 0.1};

/// Least radius ratio of the tets at v, and the sum of 1 / radius ratio.
std::pair<double, double> shape_at_vertex(const TetMesh& mesh, const Metric& metric,
                                          LocalVertex v) {
  std::pair<double, double> out{1.0, 0.0};
  for (const LocalTet& t : mesh.tets()) {
    if (!has(t, v)) continue;
    const double r = radius_ratio(mesh, metric, t);
    out.first = std::min(out.first, r);
    out.second += 1.0 / r;
  }
  return out;
}

void expect_moved_well(const TetMesh& before, const TetMesh& mesh, const Metric& metric,
                       LocalVertex v) {
  // The same tet in another order differs in the last bits; that much is no loss.
  const auto [old_worst, old_energy] = shape_at_vertex(before, metric, v);
  const auto [new_worst, new_energy] = shape_at_vertex(mesh, metric, v);
  EXPECT_GT(new_worst, std::min(old_worst, 0.3) - 1e-13);
  const double old_cost = old_energy * (1.0 + short_cost(before, metric, v));
  EXPECT_LT(new_energy + old_energy * short_cost(mesh, metric, v), old_cost + 1e-9);
  for (const LocalTet& t : mesh.tets()) ASSERT_GT(volume6_of(mesh, t), 0);
  const Point from = before.position(v), to = mesh.position(v);
  const unsigned fixed = fixed_axes(mesh.planes(v));
  EXPECT_TRUE((fixed & 1U) == 0 || from.x == to.x);
  EXPECT_TRUE((fixed & 2U) == 0 || from.y == to.y);
  EXPECT_TRUE((fixed & 4U) == 0 || from.z == to.z);
  const Quadric& old = before.quadric(v);
  const double error = old.value(metric.vector(from, to));
  EXPECT_NEAR(mesh.quadric(v).c, error, 1e-9 * (1.0 + error));
  if (!before.on_interface(v)) return;
  EXPECT_LE(error, std::max(old.c, 0.25 * old.trace()) + 1e-9);
}

TEST(Smoothing, LowersTheEnergyWithinPlanesAndQuadrics) {
  std::mt19937 random(811);
  int moves = 0, on_box = 0, on_interface = 0;
  for (int i = 0; i < 24 && !HasFailure(); ++i) {
    const Metric metric = i % 3 == 0 ? Metric({1.0, 1.0, 3.0}) : Metric();
    TetMesh mesh = random_mesh(random, metric, random_five(random));
    Smoother smoother(mesh, metric, kOptions);
    TetMesh before = mesh;
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (!mesh.is_alive(v) || !mesh.is_free(v)) continue;
      before = mesh;
      const bool moved = smoother.smooth(v);
      ASSERT_EQ(moved, mesh.position(v) != before.position(v));
      for (LocalVertex w = 0; w < mesh.vertex_count(); ++w) {
        ASSERT_TRUE(std::ranges::equal(mesh.star(w), before.star(w)));
        ASSERT_TRUE(w == v || mesh.vertex(w) == before.vertex(w));
      }
      if (!moved) continue;
      expect_moved_well(before, mesh, metric, v);
      ++moves;
      on_box += mesh.planes(v) != 0 ? 1 : 0;
      on_interface += mesh.on_interface(v) ? 1 : 0;
    }
  }
  EXPECT_GT(moves, 500);
  EXPECT_GT(on_box, 100);
  EXPECT_GT(on_interface, 100);
}

TEST(Promise3Quality, OptimisingMakesNoTetBad) {
  std::mt19937 random(812);
  OptimiseStats stats;
  for (int i = 0; i < 80 && !HasFailure(); ++i) {
    const Metric metric = i % 3 == 0 ? Metric({1.0, 1.0, 3.0}) : Metric();
    TetMesh mesh = random_mesh(random, metric, random_five(random));
    const TetMesh before = mesh;
    stats += optimise(mesh, metric, {.sweeps = 2});
    EXPECT_GE(worst_ratio(mesh, metric), std::min(worst_ratio(before, metric), 0.3) - 1e-12);
    EXPECT_EQ(volume6_sum(mesh), volume6_sum(before));
    for (const LocalTet& t : mesh.tets()) ASSERT_GT(volume6_of(mesh, t), 0);
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_EQ(mesh.is_alive(v), before.is_alive(v));
      ASSERT_TRUE(before.is_free(v) || mesh.vertex(v) == before.vertex(v));
    }
  }
  EXPECT_GT(stats.flips, 200U);
  EXPECT_GT(stats.moves, 1000U);
}

TEST(Promise1Topology, OptimisingKeepsIt) {
  std::mt19937 random(813);
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    const SmallVolume volume = random_volume(random);
    SCOPED_TRACE(volume.text());
    TetMesh mesh = dense_mesh(volume);
    for (int round = 0; round < 2; ++round) {
      simplify(mesh, Metric(), {.quality_floor = 0.02});
      optimise(mesh, Metric(), {.sweeps = 2, .flip_below = 1.0, .smooth_below = 1.0});
    }
    EXPECT_TRUE(betti(mesh, volume.label_count) == betti(volume));
  }
}

/// With every tet tried, symmetric lattices offer flips without gain; the test's time limit is what
/// fails when they are taken.
TEST(Flips, EndWhenEveryTetOfALatticeIsTried) {
  for (const std::int64_t edge : {2, 4, 6}) {
    for (const auto& spacing : {std::array{1.0, 1.0, 1.0}, {1.0, 1.0, 2.0}, {3.0, 2.0, 1.0}}) {
      TetMesh mesh =
          dense_mesh(volume_from({edge, edge, edge}, 1, [](auto, auto, auto) { return 0; }));
      const OptimiseStats stats =
          optimise(mesh, Metric(spacing), {.sweeps = 3, .flip_below = 1.0, .smooth_below = 0.0});
      EXPECT_EQ(stats.moves, 0U);
      EXPECT_EQ(volume6_sum(mesh), (edge * edge * edge * 6) << 30);
    }
  }
}

/// What a later march will move: the smooth surface waits, the rest goes on.
TEST(Optimise, LeavesFittedVerticesWhereTheyAreWhenToldTo) {
  for (const bool moves_fitted : {false, true}) {
    GuardedMesh guarded(volume_from({12, 12, 12}, 2,
                                    [](auto x, auto y, auto z) {
                                      const auto d = (x - 6) * (x - 6) + (y - 6) * (y - 6);
                                      return d + (z - 6) * (z - 6) < 20 ? 1 : 0;
                                    }),
                        1.5);
    simplify(guarded.mesh, Metric(), {.enough_vertices = 900}, &guarded.guard);
    const TetMesh before = guarded.mesh;
    const OptimiseOptions options{.flip_below = 0.0,
                                  .smooth_below = 1.0,
                                  .surface = SurfaceWeights{.bend = 0.0},
                                  .moves_fitted = moves_fitted};
    optimise(guarded.mesh, Metric(), options, &guarded.guard);
    std::array<int, 2> moved{};
    for (LocalVertex v = 0; v < before.vertex_count(); ++v) {
      const bool on_interface = before.is_free(v) && before.on_interface(v);
      if (guarded.mesh.position(v) != before.position(v)) ++moved[on_interface ? 1 : 0];
    }
    EXPECT_GT(moved[0], 20);
    EXPECT_EQ(moved[1] > 20, moves_fitted);
    EXPECT_EQ(moved[1] > 0, moves_fitted);
  }
}

bool star_is_below(const TetMesh& mesh, LocalVertex v, std::int32_t z) {
  const auto star = mesh.star(v);
  return mesh.position(v).z <= z &&
         std::all_of(star.begin(), star.end(), [&](const LinkTriangle& t) {
           const std::array others{t.a, t.b, t.c};
           return std::all_of(others.begin(), others.end(), [&](LocalVertex w) {
             return w == mesh.infinity() || mesh.position(w).z <= z;
           });
         });
}

/// Where an earlier window has fitted and nothing was contracted since, the fit and the first sweep
/// have nothing to do; a contraction gives them work again, and a second sweep leaves nothing out.
TEST(Optimise, LeavesWhatAnEarlierWindowHasSeen) {
  const SmallVolume volume = volume_from({12, 12, 12}, 2, [](auto x, auto y, auto z) {
    const auto d = (x - 6) * (x - 6) + (y - 6) * (y - 6);
    return d + (z - 6) * (z - 6) < 20 ? 1 : 0;
  });
  const std::int32_t half = 6 * kUnitsPerVoxel, end = 12 * kUnitsPerVoxel;
  const OptimiseOptions options{.earlier = {{{0, 0, 0}, {end, end, half}}},
                                .flip_below = 0.0,
                                .smooth_below = 1.0,
                                .surface = SurfaceWeights{.bend = 0.0}};
  for (const bool is_contracted : {false, true}) {
    for (const int sweeps : {0, 1, 2}) {
      GuardedMesh guarded(volume, 1.5);
      if (is_contracted) simplify(guarded.mesh, Metric(), {.enough_vertices = 900}, &guarded.guard);
      const TetMesh before = guarded.mesh;
      OptimiseOptions now = options;
      now.sweeps = sweeps;
      if (sweeps == 0) fit_interfaces(guarded.mesh, Metric(), now, &guarded.guard);
      optimise(guarded.mesh, Metric(), now, &guarded.guard);
      int seen = 0, others = 0;
      for (LocalVertex v = 0; v < before.vertex_count(); ++v) {
        if (!before.is_alive(v) || guarded.mesh.position(v) == before.position(v)) continue;
        const bool is_seen = star_is_below(before, v, half) && before.version(v) == 0;
        ++(is_seen ? seen : others);
      }
      EXPECT_GT(others, 20);
      if (sweeps < 2) {
        EXPECT_EQ(seen, 0);
      } else if (!is_contracted) {
        EXPECT_GT(seen, 20);
      }
    }
  }
}

TEST(Optimise, DoesNothingWithoutSweepsOrBadTets) {
  TetMesh mesh = dense_mesh(volume_from({4, 4, 4}, 2, [](auto x, auto, auto) { return x / 2; }));
  for (const OptimiseOptions& options :
       {OptimiseOptions{.sweeps = 0}, {.sweeps = 3, .flip_below = 0.7, .smooth_below = 0.7}}) {
    const OptimiseStats stats = optimise(mesh, Metric(), options);
    EXPECT_EQ(stats.flips + stats.moves, 0U);
  }
}

// Flips of interface edges: less bends, the same topology, and folds that go.

constexpr double kBound = 3.0;
constexpr double kFloor = 0.1;

/// How many tets of poor shape are at v.
std::uint64_t poor_tets_at(const TetMesh& mesh, const Metric& metric, LocalVertex v) {
  const auto is_poor = [&](const LinkTriangle& t) {
    return t.label != kExterior && radius_ratio(mesh, metric, mesh.position(v), t) < kDecentRatio;
  };
  return static_cast<std::uint64_t>(
      std::count_if(mesh.star(v).begin(), mesh.star(v).end(), is_poor));
}

/// Moves nothing, keeps tets positive, and each flip takes bends away, or, with a poor tet, adds no
/// more than that.
std::uint64_t expect_less_bends(GuardedMesh& guarded, const Metric& metric) {
  TetMesh& mesh = guarded.mesh;
  Unfolder unfolder(mesh, metric, SurfaceWeights{}, kFloor, guarded.guard);
  std::uint64_t flips = 0;
  double present = all_bends(mesh, metric);
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || !mesh.is_free(v) || !mesh.on_interface(v)) continue;
    const TetMesh before = mesh;
    const std::uint64_t done = unfolder.unfold(v);
    EXPECT_EQ(mesh.changes() != before.changes(), done != 0);
    if (done == 0) continue;
    flips += done;
    const double now = all_bends(mesh, metric);
    const auto all = static_cast<double>(done),
               caps = static_cast<double>(std::min(done, poor_tets_at(before, metric, v)));
    EXPECT_LT(now, present - 0.0199 * (all - caps) + 0.0201 * caps);
    present = now;
    for (LocalVertex w = 0; w < mesh.vertex_count(); ++w) {
      EXPECT_EQ(mesh.vertex(w), before.vertex(w));
      EXPECT_EQ(mesh.is_alive(w), before.is_alive(w));
    }
    for (const LocalTet& t : mesh.tets()) EXPECT_GT(volume6_of(mesh, t), 0);
    EXPECT_EQ(volume6_sum(mesh), volume6_sum(before));
  }
  for (const auto& [key, stars] : tets_by_stars(mesh)) {
    EXPECT_EQ(stars, key.label == kExterior ? 3 : 4);
  }
  return flips;
}

TEST(Unfolding, TakesBendsAwayAndKeepsTopology) {
  std::mt19937 random(821);
  std::uint64_t flips = 0;
  for (int i = 0; i < 80 && !HasFailure(); ++i) {
    const SmallVolume volume =
        i % 2 == 0 ? random_volume(random)
                   : random_volume_of(random, VolumeKind::kBlobs, {5, 5, 5}, 2 + below(random, 3));
    SCOPED_TRACE(volume.text());
    const Metric metric = i % 3 == 0 ? Metric({1.0, 1.0, 2.0}) : Metric();
    GuardedMesh guarded(volume, kBound);
    if (i % 4 < 2) simplify(guarded.mesh, metric, {.quality_floor = 0.05}, &guarded.guard);
    disturb(guarded.mesh, random);
    const std::uint64_t done = expect_less_bends(guarded, metric);
    flips += done;
    if (done == 0) continue;
    EXPECT_TRUE(betti(guarded.mesh, volume.label_count) == betti(volume));
  }
  EXPECT_GT(flips, 200U);
}

/// Calls visit(p, q) for edges whose ends are on the two sides of the crease x + y = sum.
template <typename Visit>
void each_edge_across(const TetMesh& mesh, Point sum, Visit visit) {
  for (const InterfaceEdge& e : interface_edges(interface_triangles(mesh))) {
    const Point p = mesh.position(e.ends[0]), q = mesh.position(e.ends[1]);
    if ((p.x + p.y < sum.x) != (q.x + q.y < sum.x) && p.x + p.y != sum.x && q.x + q.y != sum.x) {
      visit(e.ends[0], e.ends[1]);
    }
  }
}

/// Lifts each vertex by how far x + y is from `sum`, less the nearer it is to the top or bottom.
void crease(TetMesh& mesh, std::int32_t sum, std::int32_t height, std::int32_t half_depth) {
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    Point x = mesh.position(v);
    const std::int32_t away = std::abs((x.x + x.y) / kUnitsPerVoxel - sum);
    const std::int32_t inside = half_depth - std::abs(x.z / kUnitsPerVoxel - half_depth);
    x.z += height * std::min(away, 2) * inside / half_depth;
    mesh.move(v, x, mesh.quadric(v));
  }
  for (const LocalTet& t : mesh.tets()) ASSERT_GT(volume6_of(mesh, t), 0);
}

/// A flat interface is creased across the diagonals of its squares, which turns the crease into a
/// zigzag; all squares on it get the other diagonal.
TEST(Unfolding, PutsEdgesAlongACrease) {
  for (const std::int32_t height : {600, -600}) {
    constexpr std::int32_t kSum = 5;
    const SmallVolume volume =
        volume_from({6, 6, 8}, 2, [](auto, auto, auto z) { return z < 4 ? 0 : 1; });
    GuardedMesh guarded(volume, kBound);
    TetMesh& mesh = guarded.mesh;
    crease(mesh, kSum, height, 4);
    const Point sum{kSum * kUnitsPerVoxel, 0, 0};
    int before = 0, after = 0;
    each_edge_across(mesh, sum, [&](auto, auto) { ++before; });
    EXPECT_EQ(before, 5);
    EXPECT_GE(expect_less_bends(guarded, Metric()), 5U);
    each_edge_across(mesh, sum, [&](auto, auto) { ++after; });
    EXPECT_EQ(after, 0);
  }
}

}  // namespace
}  // namespace mw::test
