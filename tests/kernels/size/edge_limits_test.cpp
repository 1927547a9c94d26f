// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// EdgeLimits against all edges of all tets, one by one.
#include "kernels/size/edge_limits.h"

#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

/// A mesh of several cubes of a field, with limits near the lengths of its edges.
struct Case {
  SmallVolume volume;
  Metric metric;
  SizeField field;
  TetMesh mesh;

  [[nodiscard]] bool fits(Point a, Point b, Label label) const {
    const double limit = std::min({field.at(a), field.at(b), field.of_label(label)});
    return metric.vector(a, b).norm() <= limit;
  }
};

/// Labels other than 0 are at one end only: limits differ from cube to cube.
Case random_case(std::mt19937& random) {
  constexpr std::array<std::array<double, 3>, 3> kSpacings{{{1, 1, 1}, {1, 1, 2.5}, {3, 1, 2}}};
  const Index3 shape{20 + below(random, 16), 2 + below(random, 3), 3};
  const std::int64_t end = 1 + below(random, 20);
  const SmallVolume volume =
      volume_from(shape, 4, [&](auto x, auto, auto) { return x < end ? below(random, 4) : 0U; });
  const Metric metric(kSpacings[below(random, 3)]);
  std::vector<double> limits;
  for (int label = 0; label < 4; ++label) {
    limits.push_back(below(random, 3) == 0 ? SizeField::kNoLimit : 0.9 + 0.13 * below(random, 20));
  }
  SizeField field(volume.shape, metric, limits, 0.02 * below(random, 6));
  field.add({{0, 0, 0}, volume.shape}, volume.labels);
  field.spread();
  return {volume, metric, field, dense_mesh(volume)};
}

/// A place at most a voxel from p, in the volume.
Point beside(std::mt19937& random, Point p, Index3 shape) {
  const auto along = [&](std::int32_t at, std::int64_t voxels) {
    const auto moved = at + static_cast<std::int32_t>(below(random, 2 * kUnitsPerVoxel + 1));
    return std::clamp(moved - kUnitsPerVoxel, 0,
                      static_cast<std::int32_t>(voxels * kUnitsPerVoxel));
  };
  return {along(p.x, shape.x), along(p.y, shape.y), along(p.z, shape.z)};
}

bool has(const LocalTet& tet, LocalVertex v) {
  return std::find(tet.vertices.begin(), tet.vertices.end(), v) != tet.vertices.end();
}

/// The definition of allow_star().
bool star_fits(const Case& c, std::span<const LocalTet> tets, LocalVertex v, LocalVertex without,
               Point x) {
  for (const LocalTet& tet : tets) {
    if (!has(tet, v) || (without != v && has(tet, without))) continue;
    for (const LocalVertex w : tet.vertices) {
      if (w != v && !c.fits(x, c.mesh.position(w), tet.label)) return false;
    }
  }
  return true;
}

TEST(EdgeLimits, OfStarsAreThoseOfTheirEdges) {
  std::mt19937 random(2211);
  std::array<int, 2> seen{};
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Case c = random_case(random);
    if (!c.field.limits()) continue;
    const EdgeLimits limits(c.mesh, c.metric, &c.field);
    const std::vector<LocalTet> tets = c.mesh.tets();
    for (int k = 0; k < 40; ++k) {
      const LocalVertex v = below(random, c.mesh.vertex_count());
      const LinkTriangle link = c.mesh.star(v).front();
      const LocalVertex without = k % 2 == 0 ? v : link.a;
      const Point x = beside(random, c.mesh.position(v), c.volume.shape);
      const bool expected = star_fits(c, tets, v, without, x);
      EXPECT_EQ(limits.allow_star(v, without, x), expected);
      ++seen[expected ? 1 : 0];
    }
  }
  EXPECT_GT(seen[0], 200);
  EXPECT_GT(seen[1], 200);
}

/// Four vertices near each other, not all joined.
LocalTet some_tet(std::mt19937& random, const TetMesh& mesh) {
  LocalTet out;
  out.label = below(random, 4);
  out.vertices.fill(below(random, mesh.vertex_count()));
  for (std::size_t i = 1; i < 4; ++i) {
    const auto star = mesh.star(out.vertices[i - 1]);
    const LinkTriangle& t = star[below(random, static_cast<std::uint32_t>(star.size()))];
    out.vertices[i] =
        t.label == kExterior ? out.vertices[i - 1] : std::array{t.a, t.b, t.c}[below(random, 3)];
  }
  return out;
}

TEST(EdgeLimits, OfTetsAreThoseOfTheirEdges) {
  std::mt19937 random(2212);
  std::array<int, 2> seen{};
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Case c = random_case(random);
    if (!c.field.limits()) continue;
    const EdgeLimits limits(c.mesh, c.metric, &c.field);
    for (int k = 0; k < 300; ++k) {
      const LocalTet tet = some_tet(random, c.mesh);
      bool expected = true;
      for (const LocalVertex a : tet.vertices) {
        for (const LocalVertex b : tet.vertices) {
          expected = expected && c.fits(c.mesh.position(a), c.mesh.position(b), tet.label);
        }
      }
      EXPECT_EQ(limits.allow_tet(tet), expected);
      ++seen[expected ? 1 : 0];
    }
  }
  EXPECT_GT(seen[0], 1000);
  EXPECT_GT(seen[1], 1000);
}

TEST(EdgeLimits, DoNotConcernTheSpaceOutside) {
  std::mt19937 random(2213);
  const Case c = random_case(random);
  const EdgeLimits limits(c.mesh, c.metric, &c.field);
  EXPECT_TRUE(limits.allow_tet({{0, 1, 2, c.mesh.infinity()}, kExterior}));
}

TEST(EdgeLimits, WithoutAFieldAllowEverything) {
  std::mt19937 random(2214);
  const Case c = random_case(random);
  const EdgeLimits limits(c.mesh, c.metric, nullptr);
  EXPECT_FALSE(limits.any());
  EXPECT_TRUE(limits.allow_star(0, 0, c.mesh.position(c.mesh.vertex_count() - 1)));
  EXPECT_TRUE(limits.allow_tet(c.mesh.tets().front()));
}

}  // namespace
}  // namespace mw::test
