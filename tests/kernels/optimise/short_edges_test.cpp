// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What short edges cost, against the definition, and its slope against differences.
#include "kernels/optimise/short_edges.h"

#include <Eigen/Eigenvalues>

#include "tests/kernels/optimise/short_cost.h"

namespace mw::test {
namespace {

TEST(ShortEdges, CostWhatTheDefinitionSays) {
  std::mt19937 random(41);
  StarBatch star;
  ShortEdges edges;
  int costly = 0;
  for (int i = 0; i < 20; ++i) {
    const Metric metric = i % 3 == 0 ? Metric({1.0, 1.0, 2.0}) : Metric();
    TetMesh mesh = dense_mesh(random_volume(random));
    disturb(mesh, random);
    for (LocalVertex v = 0; v < mesh.vertex_count(); v += 3) {
      if (!mesh.is_alive(v)) continue;
      star.collect(mesh, metric, v);
      edges.collect(star);
      const auto away = [&] { return (static_cast<double>(below(random, 801)) - 400.0) / 1000.0; };
      const Vec3 x(away(), away(), away());
      const double cost = edges.value_at(x);
      ASSERT_NEAR(cost, short_cost(mesh, metric, v, x), 1e-9);
      costly += cost > 0.0 ? 1 : 0;
      StarTerms terms;
      edges.add_derivatives(x, 2.0, terms);
      constexpr double kStep = 1e-6;
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = kStep * Vec3::Unit(axis);
        const double slope = (edges.value_at(x + step) - edges.value_at(x - step)) / (2 * kStep);
        ASSERT_NEAR(terms.gradient[axis], 2.0 * slope, 1e-3);
      }
      ASSERT_GE(terms.hessian.eigenvalues().real().minCoeff(), -1e-9);
    }
  }
  EXPECT_GT(costly, 100);
}

}  // namespace
}  // namespace mw::test
