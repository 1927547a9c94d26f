// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Flips of interface edges: less bends, the same topology, and folds that go.
#include "kernels/optimise/unfold.h"

#include <gtest/gtest.h>

#include "kernels/simplify/simplify.h"
#include "tests/kernels/surface/interface_triangles.h"

namespace mw::test {
namespace {

constexpr double kBound = 3.0;
constexpr double kFloor = 0.1;

/// Moves nothing, keeps tets positive, and each flip takes bends away.
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
    EXPECT_LT(now, present - 0.0199 * static_cast<double>(done));
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
