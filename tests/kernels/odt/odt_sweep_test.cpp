// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where vertices go, by solving for circumcentres; and who may not move.
#include "kernels/odt/odt_sweep.h"

#include <Eigen/LU>

#include "kernels/quality/mesh_quality.h"
#include "tests/kernels/odt/window_meshes.h"

namespace mw::test {
namespace {

/// From the first corner of a tet to its circumcentre: as far from it as from the other three.
Vec3 circumcentre(const TetEdges& e) {
  Eigen::Matrix3d m;
  m << e.a.transpose(), e.b.transpose(), e.c.transpose();
  return m.inverse() * (0.5 * Vec3(e.a.squaredNorm(), e.b.squaredNorm(), e.c.squaredNorm()));
}

TEST(OdtSweep, GoesToTheMeanOfCircumcentres) {
  std::mt19937 random(1241);
  int whole_steps = 0;
  for (int i = 0; i < 40; ++i) {
    const Metric metric = i % 2 == 0 ? Metric() : Metric({1.0, 2.0, 1.0});
    // The one corner inside 2^3 voxels.
    TetMesh mesh = dense_mesh(volume_from({2, 2, 2}, 1, [](auto, auto, auto) { return 0; }));
    disturb(mesh, random);
    constexpr LocalVertex kCentre = 13;
    Vec3 sum = Vec3::Zero();
    double volume = 0.0;
    for (const LocalTet& t : mesh.tets()) {
      if (!has(t, kCentre)) continue;
      const auto& v = t.vertices;
      const TetEdges e = tet_edges(metric, mesh.position(v[0]), mesh.position(v[1]),
                                   mesh.position(v[2]), mesh.position(v[3]));
      const auto weight = static_cast<double>(volume6_of(mesh, t));
      sum +=
          weight * (metric.vector(mesh.position(kCentre), mesh.position(v[0])) + circumcentre(e));
      volume += weight;
    }
    const Point start = mesh.position(kCentre);
    const Point expected = metric.moved(start, sum / volume);
    EXPECT_LE(odt_sweep(mesh, metric, 0.0), 1U);
    const Point end = mesh.position(kCentre);
    const auto near = [](std::int32_t a, std::int32_t b) { return std::abs(a - b) <= 1; };
    whole_steps += near(end.x, expected.x) && near(end.y, expected.y) && near(end.z, expected.z);
  }
  EXPECT_GE(whole_steps, 36) << "the step is halved only where tets would turn over";
}

TEST(OdtSweep, MovesInnerFreeVerticesOnly) {
  std::mt19937 random(1242);
  std::uint64_t moves = 0;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    WindowCase window = random_window(random);
    const TetMesh before = window.mesh;
    const double floor = i % 2 == 0 ? 0.0 : 0.3;
    const std::uint64_t moved = odt_sweep(window.mesh, window.metric, floor);
    std::uint64_t elsewhere = 0;
    for (LocalVertex v = 0; v < before.vertex_count(); ++v) {
      const bool inner = before.is_free(v) && before.planes(v) == 0 && !before.on_interface(v);
      const Vec3 way = window.metric.vector(before.position(v), window.mesh.position(v));
      EXPECT_TRUE(inner || way.norm() == 0.0);
      elsewhere += way.norm() > 0.0 ? 1U : 0U;
      const double error = before.quadric(v).value(way);
      EXPECT_NEAR(window.mesh.quadric(v).c, error, 1e-9 * (1.0 + error));
    }
    EXPECT_EQ(elsewhere, moved);
    double worst = 1.0, worst_before = 1.0;
    for (const LocalTet& t : window.mesh.tets()) {
      ASSERT_GT(volume6_of(window.mesh, t), 0);
      worst = std::min(worst, radius_ratio(window.mesh, window.metric, t));
      worst_before = std::min(worst_before, radius_ratio(before, window.metric, t));
    }
    EXPECT_GE(worst, std::min(floor, worst_before) - 1e-12);
    moves += moved;
  }
  EXPECT_GT(moves, 200U);
}

}  // namespace
}  // namespace mw::test
