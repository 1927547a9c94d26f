// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Curvature of balls and of planes, and where there is none to be told.
#include <numbers>

#include "kernels/optimise/optimise.h"
#include "kernels/simplify/simplify.h"
#include "kernels/surface/surface_energy.h"
#include "kernels/surface/surface_star.h"
#include "tests/kernels/surface/interface_triangles.h"
#include "tests/oracle/small_volumes.h"

namespace mw::test {
namespace {

using audit::test::below;

/// A ball of radius 6 around the middle of 16^3 voxels.
SmallVolume ball(Label inside) {
  return volume_from({16, 16, 16}, 2, [&](auto x, auto y, auto z) {
    const auto square = [](auto i) { return (2 * i - 15) * (2 * i - 15); };
    return square(x) + square(y) + square(z) < 12 * 12 ? inside : 1 - inside;
  });
}

/// Means over all vertices where the field is known, seen from inside the ball and cut as pressure
/// cuts them: stars of few triangles say little.
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
    const double most = SurfaceWeights{}.max_curvature;
    const double cut = std::clamp(*curvature, -most, most), outward = inside == 0 ? cut : -cut;
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
      EXPECT_LE(std::abs(field.at(v).value_or(0.0)), kMaxCurvature);
      (expected ? known : unknown) += 1;
    }
    EXPECT_FALSE(field.at(mesh.vertex_count()).has_value());
  }
  EXPECT_GT(known, 100);
  EXPECT_GT(unknown, 1000);
}

// What bends cost.

double energy_of_degrees(double degrees) {
  return bend_energy(std::cos(degrees * std::numbers::pi / 180.0));
}

TEST(Bend, CostsNothingWhenItIsFlatOrFree) {
  EXPECT_EQ(energy_of_degrees(0.0), 0.0);
  EXPECT_EQ(energy_of_degrees(14.0), 0.0);
  EXPECT_GT(energy_of_degrees(14.2), 0.0);
  EXPECT_NEAR(bend_energy(1.0 - kFreeBend), 0.0, 1e-30);
}

TEST(Bend, CostsMoreTheSharperItIs) {
  for (int degrees = 15; degrees < 180; ++degrees) {
    EXPECT_LT(energy_of_degrees(degrees), energy_of_degrees(degrees + 1)) << degrees;
  }
  EXPECT_NEAR(energy_of_degrees(180.0), 4.0, 0.2);
}

/// No step and no kink where it begins to cost.
TEST(Bend, StartsGently) {
  EXPECT_LT(bend_energy(1.0 - kFreeBend - 1e-4), 2e-8);
}

/// From products of normals of any length, about the bound of what is free too.
TEST(Bend, NeedsNoUnitNormals) {
  for (const double squares : {1e-12, 1.0, 7e9}) {
    for (int i = 0; i <= 20000; ++i) {
      const double cosine = -1.0 + 1e-4 * i;
      EXPECT_NEAR(bend_energy(cosine * std::sqrt(squares), squares), bend_energy(cosine), 1e-13);
    }
  }
  EXPECT_EQ(bend_energy(0.0, 0.0), 0.0);
}

TEST(Bend, CosineIsThatOfDirections) {
  const Vec3 m(0.0, 0.0, 3.0), n(0.0, 5.0, 5.0);
  EXPECT_NEAR(cosine_between(m, n), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(cosine_between(m, -2.0 * m), -1.0, 1e-15);
  EXPECT_EQ(cosine_between(m, Vec3::Zero()), 1.0);
  EXPECT_NEAR(std::acos(kSharpCosine) * 180.0 / std::numbers::pi, 60.0, 1e-9);
}

// Debts of vertices against a map.

/// A visit replaces all that the vertex owed, pairs that are gone included.
TEST(VolumeDebts, AreThoseOfTheLastVisit) {
  std::mt19937 random(1111);
  VolumeDebts debts;
  std::map<std::tuple<LocalVertex, Label, Label>, double> expected;
  for (int i = 0; i < 300; ++i) {
    const LocalVertex visited = below(random, 5);
    std::vector<VolumeDebt> owed;
    for (Label low = 0; low < 3; ++low) {
      for (Label high = low + 1; high < 4; ++high) {
        expected.erase({visited, low, high});
        if (below(random, 2) == 0) continue;
        owed.push_back({low, high, 1.0 + i});
        expected[{visited, low, high}] = 1.0 + i;
      }
    }
    debts.set(visited, owed);
    for (LocalVertex v = 0; v < 6; ++v) {
      for (Label low = 0; low < 3; ++low) {
        for (Label high = low + 1; high < 4; ++high) {
          const auto found = expected.find({v, low, high});
          ASSERT_EQ(debts.of(v, low, high), found == expected.end() ? 0.0 : found->second);
        }
      }
    }
  }
}

}  // namespace
}  // namespace mw::test
