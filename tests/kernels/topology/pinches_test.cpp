// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// No contraction that the link condition accepts, and no flip, pinches the boundary of a label.
#include "tests/oracle/pinches.h"

#include "kernels/optimise/flips.h"
#include "kernels/simplify/simplify.h"
#include "kernels/topology/link_condition.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

using audit::test::EdgeKey;
using audit::test::is_part_of;
using audit::test::Pinched;
using audit::test::PinchedByLabel;
using audit::test::pinches_of;

PinchedByLabel pinches(const TetMesh& mesh, const std::vector<LocalTet>& tets) {
  return pinches_of(small_mesh(mesh, tets).view());
}
PinchedByLabel pinches(const TetMesh& mesh) {
  return pinches(mesh, mesh.tets());
}

/// Where pinches go when `drop` becomes `keep`.
PinchedByLabel image(const PinchedByLabel& pinched, LocalVertex keep, LocalVertex drop) {
  const auto moved = [&](std::uint64_t v) { return v == drop ? keep : v; };
  PinchedByLabel out;
  for (const auto& [label, of_label] : pinched) {
    Pinched& to = out[label];
    for (const std::uint64_t v : of_label.vertices) to.vertices.insert(moved(v));
    for (const EdgeKey& e : of_label.edges) {
      to.edges.insert(std::minmax({moved(e.first), moved(e.second)}));
    }
  }
  return out;
}

struct Counts {
  int accepted = 0;             ///< all of them keep what is pinched, or the test fails
  int of_pinched = 0;           ///< those with an end that was pinched before
  int refused_and_pinched = 0;  ///< would pinch a label where it was not
};

bool has(const PinchedByLabel& pinched, LocalVertex v) {
  return std::any_of(pinched.begin(), pinched.end(),
                     [v](const auto& entry) { return entry.second.vertices.count(v) != 0; });
}

/// Judges random edges and contracts those that are accepted, one after the other.
void judge(TetMesh& mesh, KeptTopology kept, std::mt19937& random, Counts& counts) {
  LinkCondition condition(mesh, kept);
  PinchedByLabel now = pinches(mesh);
  for (int i = 0; i < 40; ++i) {
    const auto [p, q] = random_edge(mesh, random);
    const std::uint32_t at = below(random, 3);
    const auto x = p == q ? std::nullopt : contraction_target(mesh, p, q, at);
    if (!x || !stays_positive(mesh, p, q, *x)) continue;
    const LocalVertex keep = at == 1 ? q : p, drop = at == 1 ? p : q;
    PinchedByLabel after = pinches(mesh, contracted(mesh.tets(), keep, drop));
    const bool stays = is_part_of(after, image(now, keep, drop));
    const bool inner = mesh.order(p) == 1 || mesh.order(q) == 1;
    const bool accepted = inner || condition.keeps_topology(mesh, p, q);
    ASSERT_TRUE(stays || !accepted) << "accepted, but a label is pinched where it was not";
    counts.refused_and_pinched += accepted || stays ? 0 : 1;
    if (!accepted) continue;
    counts.accepted += inner ? 0 : 1;
    counts.of_pinched += !inner && (has(now, p) || has(now, q)) ? 1 : 0;
    mesh.contract(keep, drop, *x, mesh.quadric(keep));
    now = std::move(after);
  }
}

TEST(Promise1Pinches, AcceptedContractionsPinchNothing) {
  std::mt19937 random(321);
  Counts counts;
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const SmallVolume volume = random_volume(random);
    SCOPED_TRACE(volume.text());
    TetMesh mesh = dense_mesh(volume);
    if (below(random, 2) == 0) disturb(mesh, random);
    judge(mesh, i % 3 == 0 ? KeptTopology::kInterfaces : KeptTopology::kLabels, random, counts);
  }
  EXPECT_GT(counts.accepted, 1000);
  EXPECT_GT(counts.of_pinched, 100);
  EXPECT_GT(counts.refused_and_pinched, 100);
}

/// Contracted before, so that the edges that flips remove have rings of all kinds.
TEST(Promise1Pinches, FlipsLeaveThemAsTheyAre) {
  std::mt19937 random(322);
  const Metric metric;
  int flips = 0, on_surfaces = 0, pinched = 0;
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const SmallVolume volume = random_volume_of(
        random, i % 2 == 0 ? VolumeKind::kBlobs : VolumeKind::kSpecks, {5, 5, 5}, 4);
    SCOPED_TRACE(volume.text());
    TetMesh mesh = dense_mesh(volume);
    simplify(mesh, metric, {.quality_floor = 0.0});
    disturb(mesh, random);
    const PinchedByLabel before = pinches(mesh);
    pinched += is_part_of(before, {}) ? 0 : 1;
    Flipper flipper(mesh, metric, 0.0);
    for (int k = 0; k < 300; ++k) {
      const auto [p, q] = random_edge(mesh, random);
      EdgeRing ring;
      if (p == q || !collect_ring(mesh, p, q, ring)) continue;
      const bool surface = std::set<Label>(ring.labels.begin(), ring.labels.end()).size() > 1;
      if (!flipper.remove_edge(p, q)) continue;
      ++flips;
      on_surfaces += surface ? 1 : 0;
    }
    EXPECT_TRUE(pinches(mesh) == before);
  }
  EXPECT_GT(flips, 200);
  EXPECT_GT(on_surfaces, 30);
  EXPECT_GT(pinched, 10);
}

}  // namespace
}  // namespace mw::test
