// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Limits on edges against their definition, cube by cube.
#include "kernels/size/size_field.h"

#include "kernels/core/index.h"
#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::test {
namespace {

using namespace audit::test;

/// A volume with few voxels of labels above 0, and limits on some of them.
struct Case {
  SmallVolume volume;
  Metric metric;
  std::vector<double> limits;
  double gradation = 0.0;

  [[nodiscard]] SizeField field() const {
    SizeField out(volume.shape, metric, limits, gradation);
    out.add({{0, 0, 0}, volume.shape}, volume.labels);
    out.spread();
    return out;
  }
  [[nodiscard]] Label label_at(Index3 v) const {
    return volume.labels[static_cast<std::size_t>(Box3{{0, 0, 0}, volume.shape}.offset(v))];
  }
};

Case random_case(std::mt19937& random) {
  constexpr std::array<std::array<double, 3>, 3> kSpacings{{{1, 1, 1}, {1, 1, 2.5}, {3, 1, 2}}};
  const auto edge = [&] { return std::int64_t{5 + below(random, 70)}; };
  // One volume in ten has more voxels than a field has cubes.
  const Index3 shape = below(random, 10) == 0 ? Index3{130 + edge(), 120 + edge(), 140 + edge()}
                                              : Index3{edge(), edge(), edge()};
  const auto labels = 2 + below(random, 5);
  Case out{.volume = volume_from(shape, labels,
                                 [&](auto, auto, auto) {
                                   return below(random, 3000) == 0 ? below(random, labels) : 0U;
                                 }),
           .metric = Metric(kSpacings[below(random, 3)]),
           .limits = {SizeField::kNoLimit},
           .gradation = 0.1 * below(random, 20)};
  for (std::uint32_t i = 1; i < labels; ++i) {
    out.limits.push_back(below(random, 4) == 0 ? SizeField::kNoLimit : 2 + 0.7 * below(random, 20));
  }
  return out;
}

Index3 cube_of(const Case& c, Point p) {
  const std::int64_t edge = SizeField::cube_voxels(c.volume.shape);
  const auto along = [edge](std::int32_t u, std::int64_t voxels) {
    return std::min<std::int64_t>(u / kUnitsPerVoxel, voxels - 1) / edge;
  };
  return {along(p.x, c.volume.shape.x), along(p.y, c.volume.shape.y), along(p.z, c.volume.shape.z)};
}

/// The definition: every voxel is looked at.
double defined_at(const Case& c, Point p) {
  const Index3 here = cube_of(c, p);
  const std::int64_t cube = SizeField::cube_voxels(c.volume.shape);
  const Vec3 edges = c.metric.voxel() * static_cast<double>(cube);
  const auto gap = [](std::int64_t a, std::int64_t b) {
    return static_cast<double>(std::max<std::int64_t>(std::abs(a - b) - 1, 0));
  };
  double min = SizeField::kNoLimit;
  for_each_index(c.volume.shape, [&](Index3 v) {
    const double limit = c.limits[c.label_at(v)];
    if (limit == SizeField::kNoLimit) return;
    const Vec3 gaps{gap(here.x, v.x / cube) * edges[0], gap(here.y, v.y / cube) * edges[1],
                    gap(here.z, v.z / cube) * edges[2]};
    min = std::min(min, limit + c.gradation * gaps.norm());
  });
  return min;
}

Point random_position(std::mt19937& random, Index3 shape) {
  const auto along = [&](std::int64_t voxels) {
    return static_cast<std::int32_t>(
        below(random, static_cast<std::uint32_t>(voxels * kUnitsPerVoxel + 1)));
  };
  return {along(shape.x), along(shape.y), along(shape.z)};
}

TEST(SizeField, IsWhatItsDefinitionSays) {
  std::mt19937 random(2201);
  int limited = 0, large = 0;
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    const Case c = random_case(random);
    const SizeField field = c.field();
    large += SizeField::cube_voxels(c.volume.shape) > 1 ? 1 : 0;
    for (int k = 0; k < 8; ++k) {
      const Point p = random_position(random, c.volume.shape);
      const double expected = defined_at(c, p);
      if (expected == SizeField::kNoLimit) {
        EXPECT_EQ(field.at(p), expected);
        continue;
      }
      ++limited;
      EXPECT_LE(field.at(p), expected * (1 + 1e-12));
      EXPECT_GE(field.at(p), expected * (1 - 1e-6));
    }
  }
  EXPECT_GT(limited, 100);
  EXPECT_GT(large, 1);
}

TEST(SizeField, RoundsManyLimitsDownByATwentiethAtMost) {
  std::mt19937 random(2207);
  constexpr std::uint32_t kLabels = 300;
  Case c{.volume = volume_from({40, 30, 20}, kLabels,
                               [&](auto, auto, auto) { return below(random, kLabels); }),
         .gradation = 0.3};
  for (std::uint32_t i = 0; i < kLabels; ++i) c.limits.push_back(2 + 0.01 * i);
  const SizeField field = c.field();
  bool any_is_less = false;
  for (int k = 0; k < 100; ++k) {
    const Point p = random_position(random, c.volume.shape);
    const double expected = defined_at(c, p);
    EXPECT_LE(field.at(p), expected * (1 + 1e-6));
    EXPECT_GE(field.at(p), expected / 1.05 * (1 - 1e-6));
    any_is_less = any_is_less || field.at(p) < 0.999 * expected;
  }
  EXPECT_TRUE(any_is_less);
  EXPECT_EQ(field.of_label(7), c.limits[7]);
}

/// Places out of reach of the volume are asked for before a vertex there is refused.
TEST(SizeField, OutsideIsAsAtTheNearestPlaceInside) {
  std::mt19937 random(1907);
  for (int i = 0; i < 40; ++i) {
    const Case c = random_case(random);
    const SizeField field = c.field();
    const Index3 shape = c.volume.shape;
    const auto anywhere = [&](std::int64_t voxels) {
      const auto units = static_cast<std::uint32_t>(voxels * kUnitsPerVoxel);
      return static_cast<std::int32_t>(below(random, 3 * units)) - static_cast<std::int32_t>(units);
    };
    const auto inside = [](std::int32_t u, std::int64_t voxels) {
      return std::clamp(u, 0, static_cast<std::int32_t>(voxels * kUnitsPerVoxel));
    };
    for (int k = 0; k < 200; ++k) {
      const Point p{anywhere(shape.x), anywhere(shape.y), anywhere(shape.z)};
      const Point near{inside(p.x, shape.x), inside(p.y, shape.y), inside(p.z, shape.z)};
      EXPECT_EQ(field.at(p), field.at(near));
    }
  }
}

TEST(SizeField, HasCubesThatAreFewAndAtMostOfEightVoxels) {
  const auto of = [](std::int64_t n) { return SizeField::cube_voxels({n, n, n}); };
  EXPECT_EQ(of(96), 1);
  EXPECT_EQ(of(128), 1);
  EXPECT_EQ(of(129), 2);
  EXPECT_EQ(of(512), 4);
  EXPECT_EQ(of(1024), 8);
  EXPECT_EQ(of(4096), 8);
}

TEST(SizeField, TakesLimitsOfVoxelsWhateverTheirLabels) {
  SizeField field({20, 10, 10}, Metric({1, 1, 1}), {SizeField::kNoLimit}, 0.5, true);
  field.limit_voxel({3, 4, 5}, 2.0);
  field.limit_voxel({3, 4, 5}, 3.0);
  field.limit_voxel({15, 4, 5}, 2.5);
  field.spread();
  const auto at = [&](std::int32_t x) {
    return field.at({x * kUnitsPerVoxel, 4 * kUnitsPerVoxel, 5 * kUnitsPerVoxel});
  };
  EXPECT_EQ(at(3), 2.0);
  EXPECT_EQ(at(7), 2.0 + 0.5 * 3);  // from box to box
  EXPECT_EQ(at(15), 2.5);
  EXPECT_TRUE(field.is_asked(0));
}

TEST(SizeField, RoundsLimitsToFew) {
  std::set<double> rungs;
  for (double limit = 0.05; limit < 40.0; limit *= 1.003) {
    const double rung = SizeField::rung_below(limit);
    EXPECT_LE(rung, limit);
    EXPECT_GT(rung, limit / 1.051);
    rungs.insert(rung);
  }
  EXPECT_LT(rungs.size(), 150U);
}

/// An image of sizes keeps them as they are where they are few, and nearly so where their range is
/// small.
TEST(SizeField, RoundsManyLimitsByAsLittleAsLeavesFew) {
  const auto expect_near = [](int limits, double ratio, double least) {
    SizeField field({400, 1, 1}, Metric({1, 1, 1}), {SizeField::kNoLimit}, 10.0, true);
    const auto limit = [&](int x) {
      return 2.5 * std::pow(ratio, static_cast<double>(x * limits / 400) / limits);
    };
    for (int x = 0; x < 400; ++x) field.limit_voxel({x, 0, 0}, limit(x));
    field.spread();
    for (int x = 0; x < 400; ++x) {
      const double found = field.at({x * kUnitsPerVoxel, 0, 0});
      EXPECT_LE(found, limit(x) * (1 + 1e-6));
      // Neighbours are at no distance.
      EXPECT_GE(found, limit(std::max(x - 1, 0)) * least * (1 - 1e-6)) << limits << " " << ratio;
    }
  };
  expect_near(50, 3.0, 1.0);
  expect_near(400, 2.0, 1 / 1.0125);
  expect_near(400, 4.0, 1 / 1.025);
  expect_near(400, 20.0, 1 / 1.05);
}

TEST(SizeField, AllowsCellsWhoseDiagonalFitsAtAllTheirCorners) {
  std::mt19937 random(2202);
  std::array<int, 2> seen{};
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    const Case c = random_case(random);
    const SizeField field = c.field();
    for (int k = 0; k < 20; ++k) {
      const int level = 1 + static_cast<int>(below(random, 4));
      const auto units = std::int32_t{kUnitsPerVoxel << level};
      Point lo = random_position(random, c.volume.shape);
      lo = {lo.x / units * units, lo.y / units * units, lo.z / units * units};
      const Point hi{lo.x + units, lo.y + units, lo.z + units};
      if (hi.x > c.volume.shape.x * kUnitsPerVoxel || hi.y > c.volume.shape.y * kUnitsPerVoxel ||
          hi.z > c.volume.shape.z * kUnitsPerVoxel) {
        continue;
      }
      double min = SizeField::kNoLimit;
      for_each_index(Index3{3, 3, 3}, [&](Index3 at) {
        min = std::min(min, field.at({lo.x + static_cast<std::int32_t>(at.x) * units / 2,
                                      lo.y + static_cast<std::int32_t>(at.y) * units / 2,
                                      lo.z + static_cast<std::int32_t>(at.z) * units / 2}));
      });
      const Label label =
          c.label_at({lo.x / kUnitsPerVoxel, lo.y / kUnitsPerVoxel, lo.z / kUnitsPerVoxel});
      const bool fits = c.metric.vector(lo, hi).norm() <= std::min(min, c.limits[label]);
      const Index3 voxel{lo.x / kUnitsPerVoxel, lo.y / kUnitsPerVoxel, lo.z / kUnitsPerVoxel};
      EXPECT_EQ(field.allows_cell(voxel, level, label), fits);
      EXPECT_TRUE(field.allows_cell(voxel, 0, label));
      ++seen[fits ? 1 : 0];
    }
  }
  EXPECT_GT(seen[0], 40);
  EXPECT_GT(seen[1], 40);
}

}  // namespace
}  // namespace mw::test
