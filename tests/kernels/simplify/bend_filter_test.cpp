// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Verdicts on folds against bends of the really contracted mesh.
#include "kernels/simplify/bend_filter.h"

#include <gtest/gtest.h>

#include <tuple>

#include "kernels/simplify/simplify.h"
#include "kernels/topology/link_condition.h"
#include "tests/kernels/surface/interface_triangles.h"

namespace mw::test {
namespace {

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
        const double allowed = mesh.order(p) == 2 && mesh.order(q) == 2 ? 0.5 : 1.0;
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

}  // namespace
}  // namespace mw::test
