// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Curvature of balls and of planes, and where there is none to be told.
#include "kernels/surface/surface_star.h"

#include <gtest/gtest.h>

#include "kernels/optimise/optimise.h"
#include "kernels/simplify/simplify.h"
#include "tests/kernels/surface/interface_triangles.h"

namespace mw::test {
namespace {

/// A ball of radius 6 around the middle of 16^3 voxels.
SmallVolume ball(Label inside) {
  return volume_from({16, 16, 16}, 2, [&](auto x, auto y, auto z) {
    const auto square = [](auto i) { return (2 * i - 15) * (2 * i - 15); };
    return square(x) + square(y) + square(z) < 12 * 12 ? inside : 1 - inside;
  });
}

/// Means over all vertices where the field is known, seen from inside the ball.
struct OfBall {
  double mean = 0.0;
  double right_sign = 0.0;  ///< share
  double count = 0.0;
};

OfBall measure(const TetMesh& mesh, Label inside) {
  CurvatureField field;
  field.measure(mesh, Metric());
  OfBall out;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    const auto curvature = field.at(v);
    EXPECT_EQ(curvature.has_value(), mesh.is_alive(v) && mesh.on_interface(v));
    if (!curvature) continue;
    const double outward = inside == 0 ? *curvature : -*curvature;
    out.mean += outward;
    out.right_sign += outward > 0.0 ? 1.0 : 0.0;
    out.count += 1.0;
  }
  out.mean /= out.count;
  out.right_sign /= out.count;
  return out;
}

/// Twice the mean curvature of a ball is 2 / radius, positive where the smaller label is inside.
TEST(CurvatureField, OfABallIsThatOfItsRadius) {
  for (const Label inside : {0U, 1U}) {
    TetMesh mesh = dense_mesh(ball(inside));
    const Point middle{8 * kUnitsPerVoxel, 8 * kUnitsPerVoxel, 8 * kUnitsPerVoxel};
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (!mesh.on_interface(v)) continue;
      const Vec3 out = Metric().vector(middle, mesh.position(v));
      mesh.move(v, Metric().moved(middle, 6.0 * out.normalized()), mesh.quadric(v));
    }
    const OfBall found = measure(mesh, inside);
    EXPECT_GT(found.count, 300.0);
    EXPECT_NEAR(found.mean, 2.0 / 6.0, 0.1 * 2.0 / 6.0);
    EXPECT_GT(found.right_sign, 0.95);
  }
}

TEST(CurvatureField, OfAVoxelBallIsSoAfterSmoothing) {
  for (const Label inside : {0U, 1U}) {
    GuardedMesh guarded(ball(inside), 1.5);
    const OptimiseOptions options{.sweeps = 4, .surface = SurfaceWeights{}};
    fit_interfaces(guarded.mesh, Metric(), options, &guarded.guard);
    simplify(guarded.mesh, Metric(), {.keep_smooth = true}, &guarded.guard);
    optimise(guarded.mesh, Metric(), options, &guarded.guard);
    const OfBall found = measure(guarded.mesh, inside);
    EXPECT_GT(found.count, 20.0);
    EXPECT_NEAR(found.mean, 2.0 / 6.0, 0.2 * 2.0 / 6.0);
    EXPECT_GT(found.right_sign, 0.95);
  }
}

TEST(CurvatureField, OfAPlaneIsZero) {
  const Metric metric({1.0, 1.0, 2.0});
  const TetMesh mesh =
      dense_mesh(volume_from({6, 6, 6}, 2, [](auto, auto y, auto) { return y < 3 ? 0 : 1; }));
  CurvatureField field;
  field.measure(mesh, metric);
  int known = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!field.at(v)) continue;
    EXPECT_NEAR(*field.at(v), 0.0, 1e-12);
    ++known;
  }
  EXPECT_EQ(known, 25);
}

/// Only free vertices between exactly two labels, off the box; never beyond the clamp.
TEST(CurvatureField, IsUnknownAtJunctionsOnTheBoxAndAtFixedVertices) {
  std::mt19937 random(1131);
  int known = 0, unknown = 0;
  for (std::uint32_t i = 0; i < 40 && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    const SmallVolume volume = random_volume_of(random, kind, {6, 5, 6}, 2 + below(random, 3));
    TetMesh mesh = i % 2 == 0 ? dense_mesh(volume) : dense_cutout(volume, {{1, 0, 1}, {5, 5, 5}});
    disturb(mesh, random);
    CurvatureField field;
    EXPECT_FALSE(field.at(0).has_value());
    field.measure(mesh, Metric());
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      std::set<Label> labels;
      for (const LinkTriangle& t : mesh.star(v)) labels.insert(t.label);
      const bool expected = mesh.is_free(v) && labels.size() == 2 && labels.count(kExterior) == 0;
      ASSERT_EQ(field.at(v).has_value(), expected) << v;
      EXPECT_LE(std::abs(field.at(v).value_or(0.0)), 0.5);
      (expected ? known : unknown) += 1;
    }
    EXPECT_FALSE(field.at(mesh.vertex_count()).has_value());
  }
  EXPECT_GT(known, 100);
  EXPECT_GT(unknown, 1000);
}

}  // namespace
}  // namespace mw::test
