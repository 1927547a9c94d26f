// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// simplify() on windows cut out of larger volumes: what it must leave alone and what it must keep.
#include <thread>

#include "kernels/mesh/star_boxes.h"
#include "kernels/optimise/optimise.h"
#include "kernels/quality/quality.h"
#include "kernels/simplify/contraction_filters.h"
#include "kernels/simplify/simplify.h"
#include "kernels/surface/thin_label.h"
#include "kernels/topology/link_condition.h"
#include "tests/kernels/mesh/dense_mesh.h"
#include "tests/kernels/surface/interface_triangles.h"

namespace mw::test {
namespace {

SmallVolume random_of(std::mt19937& random, std::int64_t edge, std::uint32_t labels) {
  const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
  return random_volume_of(random, kind, {edge, edge, edge}, labels);
}

std::int64_t positive_volume6(const TetMesh& mesh) {
  std::int64_t sum = 0;
  for (const LocalTet& t : mesh.tets()) {
    EXPECT_GT(volume6_of(mesh, t), 0);
    sum += volume6_of(mesh, t);
  }
  return sum;
}

TEST(Sec41FreeVertices, SimplifyLeavesFixedVerticesUntouched) {
  std::mt19937 random(721);
  std::uint64_t contractions = 0;
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const SmallVolume volume = random_of(random, 7, 1 + below(random, 4));
    TetMesh mesh = dense_cutout(volume, {{1, 0, 2}, {6, 5, 7}});
    const TetMesh before = mesh;
    contractions += simplify(mesh, Metric(), {}).contracted;
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (before.is_free(v)) continue;
      ASSERT_TRUE(mesh.is_alive(v));
      ASSERT_FALSE(mesh.is_free(v));
      ASSERT_EQ(mesh.vertex(v), before.vertex(v));
    }
    EXPECT_EQ(positive_volume6(mesh), positive_volume6(before));
  }
  EXPECT_GT(contractions, 2000U);
}

/// Vertices whose stars lie in a finished box are not looked at; others are, at its side, too.
TEST(FinishedBoxes, SimplifyAndOptimiseLeaveThemAlone) {
  std::mt19937 random(728);
  constexpr std::int32_t kFar = 1 << 24, kPlane = 5 * kUnitsPerVoxel;
  std::uint64_t contracted = 0, of_all = 0;
  for (int i = 0; i < 20 && !HasFailure(); ++i) {
    const TetMesh start = dense_mesh(random_of(random, 9, 1 + below(random, 4)));
    const std::vector<LatticeBox> low{{{-kFar, -kFar, -kFar}, {kPlane, kFar, kFar}}};
    const std::vector<LatticeBox> all{{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}}};
    const FinishedVertices finished(start, low);
    for (LocalVertex v = 0; v < start.vertex_count(); ++v) {
      EXPECT_EQ(finished.has(v), start.position(v).x < kPlane);
    }
    TetMesh mesh = start, half = start, whole = start;
    SimplifyOptions options;
    of_all += simplify(mesh, Metric(), options).contracted;
    options.finished = low;
    contracted += simplify(half, Metric(), options).contracted;
    options.finished = all;
    OptimiseOptions polish;
    polish.finished = all;
    EXPECT_EQ(simplify(whole, Metric(), options).tried, 0U);
    EXPECT_EQ(optimise(whole, Metric(), polish).moves, 0U);
    EXPECT_EQ(whole.changes(), start.changes());
  }
  EXPECT_GT(contracted, of_all / 3);
  EXPECT_LE(contracted, of_all);
}

TEST(Promise3Quality, SimplifyNeverGoesBelowTheFloor) {
  std::mt19937 random(722);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Metric metric = i % 2 == 0 ? Metric() : Metric({1.0, 1.0, 6.0});
    TetMesh mesh = dense_mesh(random_of(random, 5, 1 + below(random, 4)));
    const double floor = 0.05 * (1 + below(random, 6));
    const double promised = std::min(floor, worst_ratio(mesh, metric));
    simplify(mesh, metric, {.quality_floor = floor});
    EXPECT_GE(worst_ratio(mesh, metric), promised - 1e-12);
  }
}

TEST(Promise1Topology, SimplifyAndItsRepetitionKeepIt) {
  std::mt19937 random(723);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const SmallVolume volume = random_of(random, 4, 1 + below(random, 8));
    SCOPED_TRACE(volume.text());
    TetMesh mesh = dense_mesh(volume);
    const std::int64_t before = positive_volume6(mesh);
    for (int round = 0; round < 2; ++round) {
      simplify(mesh, Metric(), {.quality_floor = 0.02});
      disturb(mesh, random);
    }
    EXPECT_TRUE(betti(mesh, volume.label_count) == betti(volume));
    EXPECT_EQ(positive_volume6(mesh), before);
  }
}

TEST(Simplify, CountsEveryTryOnceAndRepeatsExactly) {
  std::mt19937 random(724);
  for (int i = 0; i < 20; ++i) {
    const SmallVolume volume = random_of(random, 5, 3);
    TetMesh mesh = dense_mesh(volume), again = dense_mesh(volume);
    const SimplifyStats s = simplify(mesh, Metric(), {});
    EXPECT_EQ(s.tried, s.contracted + s.inverted + s.low_quality + s.topology + s.distance);
    std::size_t alive = 0;
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) alive += mesh.is_alive(v) ? 1U : 0U;
    EXPECT_EQ(alive + s.contracted, mesh.vertex_count());
    simplify(again, Metric(), {});
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_EQ(again.vertex(v), mesh.vertex(v));
      EXPECT_TRUE(std::ranges::equal(again.star(v), mesh.star(v)));
    }
  }
}

/// Real threads, each with every n-th of many short ranges.
ParallelFor on_threads(std::size_t threads) {
  return [threads](std::size_t n, const RangeBody& body) {
    constexpr std::size_t kRange = 50;
    std::vector<std::thread> all;
    for (std::size_t t = 0; t < threads; ++t) {
      all.emplace_back([=, &body] {
        for (std::size_t first = t * kRange; first < n; first += threads * kRange) {
          body(first, std::min(n, first + kRange));
        }
      });
    }
    for (std::thread& thread : all) thread.join();
  };
}

TEST(Promise5SameBytes, SimplifyForgetsHowItsQueueWasSeeded) {
  std::mt19937 random(726);
  std::uint64_t contractions = 0;
  for (std::size_t i = 0; i < 24 && !HasFailure(); ++i) {
    const SmallVolume volume = random_of(random, 7, 1 + below(random, 4));
    const TetMesh start = dense_cutout(volume, {{1, 0, 2}, {6, 5, 7}});
    TetMesh mesh = start, threaded = start;
    contractions += simplify(mesh, Metric(), {}).contracted;
    simplify(threaded, Metric(), {.seeding = on_threads(1 + i % 8)});
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_EQ(threaded.vertex(v), mesh.vertex(v));
      ASSERT_TRUE(std::ranges::equal(threaded.star(v), mesh.star(v)));
    }
  }
  EXPECT_GT(contractions, 500U);
}

/// An inside without interfaces has no reason to keep its vertices.
TEST(Simplify, EmptiesTheInsideOfALabel) {
  TetMesh mesh = dense_mesh(volume_from({8, 8, 8}, 1, [](auto, auto, auto) { return 0; }));
  simplify(mesh, Metric(), {.inner_quality = 0.3});
  int inner = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    inner += mesh.is_alive(v) && mesh.planes(v) == 0 ? 1 : 0;
  }
  EXPECT_LT(inner, 7 * 7 * 7 / 5);
}

TEST(Sec54Filters, EdgeVarianceBindsTheChangedTets) {
  std::mt19937 random(725);
  for (int i = 0; i < 20; ++i) {
    const SmallVolume volume = random_of(random, 5, 3);
    TetMesh free = dense_mesh(volume), bound = dense_mesh(volume);
    const auto more = simplify(free, Metric(), {}).contracted;
    EXPECT_LE(simplify(bound, Metric(), {.edge_variance = 0.08}).contracted, more);
    for (const LocalTet& t : bound.tets()) {
      const auto& v = t.vertices;
      EXPECT_LT(edge_length_variance(tet_edges(Metric(), bound.position(v[0]), bound.position(v[1]),
                                               bound.position(v[2]), bound.position(v[3]))),
                0.08 + 1e-12);
    }
  }
}

/// An edge variance is below 1, so a bound of 1 refuses nothing; what differs are the places tried.
TEST(Sec54Filters, OtherPlacesLetMoreThroughAndThePapersFilterGoesWithoutThem) {
  std::mt19937 random(726);
  std::uint64_t with = 0, without = 0;
  for (int i = 0; i < 20; ++i) {
    const SmallVolume volume = random_of(random, 6, 3);
    TetMesh free = dense_mesh(volume), paper = dense_mesh(volume);
    with += simplify(free, Metric(), {.quality_floor = 0.2}).contracted;
    without += simplify(paper, Metric(), {.quality_floor = 0.2, .edge_variance = 1.0}).contracted;
  }
  EXPECT_GT(with, without + without / 100);
}

// Verdicts on folds against bends of the really contracted mesh.

using FanRow = std::tuple<LocalVertex, LocalVertex, Label, Label, bool>;

std::vector<FanRow> rows_of(std::span<const FanTriangle> fan) {
  std::vector<FanRow> out;
  for (const FanTriangle& t : fan) out.emplace_back(t.a, t.b, t.low, t.high, t.faces_high);
  return out;
}

std::vector<FanRow> fan_of(const TetMesh& mesh, LocalVertex v) {
  InterfaceFan fan;
  std::vector<FanTriangle> triangles;
  fan.collect(mesh, v, triangles);
  return rows_of(triangles);
}

/// Candidates of one vertex share its star: the answer must not depend on who asked before.
void ask_about_another(BendFilter& filter, const TetMesh& mesh, LocalVertex p, LocalVertex q,
                       std::mt19937& random) {
  const auto star = mesh.star(p);
  const LocalVertex r = star[below(random, static_cast<std::uint32_t>(star.size()))].b;
  if (r == mesh.infinity() || r == q || !mesh.is_free(r)) return;
  const bool keeps_p = below(random, 2) == 0;
  static_cast<void>(filter.stays_smooth(
      {.keep = keeps_p ? p : r, .drop = keeps_p ? r : p, .position = mesh.position(p)}));
}

/// One filter for all questions about a mesh that changes between them.
TEST(BendFilter, ComparesTheContractedMeshWithThePresentOne) {
  std::mt19937 random(731);
  int refused = 0, allowed_by_share = 0, free = 0;
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Metric metric = i % 2 == 0 ? Metric() : Metric({1.0, 2.0, 1.5});
    const auto kind = i % 3 == 0 ? VolumeKind::kNoise : VolumeKind::kBlobs;
    TetMesh mesh = dense_mesh(random_volume_of(random, kind, {5, 5, 5}, 2 + below(random, 3)));
    disturb(mesh, random);
    if (i % 4 < 2) simplify(mesh, metric, {.quality_floor = 0.02});
    BendFilter filter(mesh, metric);
    LinkCondition topology(mesh);
    for (int k = 0; k < 150 && !HasFailure(); ++k) {
      const auto [p, q] = random_edge(mesh, random);
      if (p == q || !mesh.on_interface(p) || !mesh.on_interface(q)) continue;
      if (!topology.keeps_topology(mesh, p, q)) continue;
      for (const std::uint32_t at : {0U, 2U, 1U}) {
        const auto target = contraction_target(mesh, p, q, at);
        if (!target || !stays_positive(mesh, p, q, *target)) continue;
        ask_about_another(filter, mesh, p, q, random);
        const bool verdict = filter.stays_smooth({.keep = p, .drop = q, .position = *target});
        ASSERT_EQ(rows_of(filter.fan(p)), fan_of(mesh, p));
        ASSERT_EQ(rows_of(filter.fan(q)), fan_of(mesh, q));
        TetMesh contracted = mesh;
        contracted.contract(p, q, *target, mesh.quadric(p));
        const double present = bends_around(mesh, metric, p) + bends_around(mesh, metric, q);
        const double after = bends_around(contracted, metric, p);
        const double allowed = mesh.order(p) == 2 && mesh.order(q) == 2 ? 0.38 : 0.55;
        const double max = 0.8 * present + allowed;
        if (std::abs(after - max) < 1e-9) continue;
        ASSERT_EQ(verdict, after < max) << present << " " << after;
        (!verdict ? refused : after > allowed ? allowed_by_share : free) += 1;
        if (below(random, 8) != 0) continue;
        mesh.contract(p, q, *target, mesh.quadric(p));
        break;
      }
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(allowed_by_share, 100);
  EXPECT_GT(free, 100);
}

/// A sheet that climbs by a voxel in every four touches itself along the edges of its steps.
TEST(BendFilter, AllowsLessOnSheetsThatTouchThemselves) {
  std::mt19937 random(733);
  const Metric metric;
  const SmallVolume volume =
      volume_from({16, 10, 9}, 2, [](auto x, auto, auto z) { return z == 2 + x / 4 ? 1 : 0; });
  const LabelBox labels = labels_in(volume, {{0, 0, 0}, volume.shape});
  int refused = 0, allowed = 0, beside = 0;
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    TetMesh mesh = dense_mesh(volume);
    disturb(mesh, random);
    LinkCondition topology(mesh);
    BendFilter filter(mesh, metric, &labels), elsewhere(mesh, metric);
    for (int k = 0; k < 500; ++k) {
      const auto [p, q] = random_edge(mesh, random);
      if (p == q || mesh.order(p) != 2 || mesh.order(q) != 2) continue;
      const Contraction c{.keep = p, .drop = q, .position = mesh.position(p)};
      if (!topology.keeps_topology(mesh, p, q)) continue;
      if (!stays_positive(mesh, p, q, c.position) || !elsewhere.stays_smooth(c)) continue;
      const bool verdict = filter.stays_smooth(c);
      const auto thin = thin_label_at(labels, c.position, 1);
      if (!thin || !thin->is_held) {
        EXPECT_TRUE(verdict);
        ++beside;
        continue;
      }
      TetMesh contracted = mesh;
      contracted.contract(p, q, c.position, mesh.quadric(p));
      const double present = bends_around(mesh, metric, p) + bends_around(mesh, metric, q);
      const double after = bends_around(contracted, metric, p), most = 0.6 * present + 0.1;
      if (std::abs(after - most) < 1e-9) continue;
      EXPECT_EQ(verdict, after < most);
      (verdict ? allowed : refused) += 1;
    }
  }
  EXPECT_GT(refused, 20);
  EXPECT_GT(allowed, 20);
  EXPECT_GT(beside, 20);
}

/// A bend of a thousandth of a voxel is free elsewhere.
TEST(BendFilter, KeepsInItsPlaneWhatIsFlatThere) {
  std::mt19937 random(732);
  int flat = 0, at_a_step = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto along_axis = [&](Index3 v) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; };
    const auto beside = [&](Index3 v) { return axis == 0 ? v.y : v.x; };
    SmallVolume volume{{8, 8, 8}, 2, {}};
    for_each_index(volume.shape, [&](Index3 v) {
      volume.labels.push_back(along_axis(v) < (beside(v) < 5 ? 4 : 3) ? 0 : 1);
    });
    const TetMesh mesh = dense_mesh(volume);
    const Metric metric;
    BendFilter filter(mesh, metric);
    const auto carries_the_step = [&](LocalVertex v) {
      const Point p = mesh.position(v);
      return axis == 0 ? p.y >= 5 * kUnitsPerVoxel : p.x >= 5 * kUnitsPerVoxel;
    };
    for (int k = 0; k < 6000; ++k) {
      const auto [p, q] = random_edge(mesh, random);
      if (p == q || mesh.order(p) != 2 || mesh.order(q) != 2) continue;
      if (mesh.planes(p) != 0 || mesh.planes(q) != 0) continue;
      const Point stays = mesh.position(p);
      const Point leaves = with_coordinate(stays, axis, along(stays, axis) + 1);
      if (along(mesh.position(q), axis) != along(stays, axis)) continue;
      const Contraction away{.keep = p, .drop = q, .position = leaves, .moves = true};
      if (carries_the_step(p) || carries_the_step(q)) {
        at_a_step += filter.stays_smooth(away) ? 1 : 0;
        continue;
      }
      EXPECT_TRUE(filter.stays_smooth({.keep = p, .drop = q, .position = stays}));
      EXPECT_FALSE(filter.stays_smooth(away));
      ++flat;
    }
  }
  EXPECT_GT(flat, 100);
  EXPECT_GT(at_a_step, 10);
}

}  // namespace
}  // namespace mw::test
