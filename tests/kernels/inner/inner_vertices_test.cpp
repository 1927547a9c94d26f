// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// New inner vertices change shapes inside labels and nothing else, and stay.
#include "kernels/inner/inner_vertices.h"

#include "kernels/optimise/optimise.h"
#include "kernels/quality/quality.h"
#include "kernels/simplify/simplify.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

constexpr double kFloor = 0.1;
constexpr VertexId kFirstId = VertexId{1} << 63;

InnerDemand random_demand(std::mt19937& random, std::size_t labels) {
  std::vector<bool> wanted(labels);
  for (std::size_t i = 0; i < labels; ++i) wanted[i] = below(random, 4) != 0;
  return InnerDemand(wanted);
}

/// Labels around each vertex, from the list of tets; the box counts as one.
std::size_t count_lacking(const TetMesh& mesh, const InnerDemand& demand) {
  std::vector<std::set<Label>> labels(mesh.vertex_count());
  const std::vector<LocalTet> tets = mesh.tets();
  for (const LocalTet& t : tets) {
    for (const LocalVertex v : t.vertices) labels[v].insert(t.label);
  }
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.planes(v) != 0) labels[v].insert(kExterior);
  }
  return static_cast<std::size_t>(std::count_if(tets.begin(), tets.end(), [&](const LocalTet& t) {
    return demand.wants(t.label) &&
           std::all_of(t.vertices.begin(), t.vertices.end(),
                       [&](LocalVertex v) { return labels[v].size() > 1; });
  }));
}

/// Triangles with a tet of each of two labels, or one tet, by ids.
std::multiset<std::array<VertexId, 3>> boundary_triangles(const TetMesh& mesh) {
  std::map<std::array<VertexId, 3>, std::vector<Label>> beside;
  for (const LocalTet& t : mesh.tets()) {
    for (int corner = 0; corner < 4; ++corner) {
      const LinkTriangle f = link_triangle(t, corner);
      std::array<VertexId, 3> ids{mesh.id(f.a), mesh.id(f.b), mesh.id(f.c)};
      std::sort(ids.begin(), ids.end());
      beside[ids].push_back(t.label);
    }
  }
  std::multiset<std::array<VertexId, 3>> out;
  for (const auto& [ids, labels] : beside) {
    EXPECT_LE(labels.size(), 2U);
    if (labels.size() == 1 || labels[0] != labels[1]) out.insert(ids);
  }
  return out;
}

std::map<Label, std::int64_t> volumes(const TetMesh& mesh) {
  std::map<Label, std::int64_t> out;
  for (const LocalTet& t : mesh.tets()) {
    EXPECT_GT(volume6_of(mesh, t), 0);
    out[t.label] += volume6_of(mesh, t);
  }
  return out;
}

struct Case {
  SmallVolume volume;
  Metric metric;
  TetMesh mesh;
  InnerDemand demand;
};

/// A simplified mesh; odd ones are cut out of a larger volume, with fixed vertices.
Case random_case(std::mt19937& random, int i) {
  const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
  SmallVolume volume = random_volume_of(random, kind, {8, 7, 9}, 1 + below(random, 4));
  const Metric metric = i % 3 == 0 ? Metric({1, 1, 1.5}) : Metric();
  TetMesh mesh = i % 2 == 0 ? dense_mesh(volume) : dense_cutout(volume, {{1, 0, 2}, {8, 6, 9}});
  simplify(mesh, metric, {.quality_floor = kFloor});
  InnerDemand demand = random_demand(random, volume.label_count);
  return {std::move(volume), metric, std::move(mesh), std::move(demand)};
}

std::uint64_t add_inner(Case& c, TetMesh& mesh) {
  CarriedSamples none;
  return add_inner_vertices(
      mesh, none, far_corner(c.volume.shape), c.metric, c.demand,
      {.limits = {.min_ratio = kFloor}, .later = {}, .ids = {kFirstId, 1U << 20U}});
}

TEST(InnerVertices, ChangeNothingButTetsInsideLabels) {
  std::mt19937 random(2301);
  std::size_t before = 0, after = 0;
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    Case c = random_case(random, i);
    TetMesh mesh = c.mesh;
    const std::uint64_t added = add_inner(c, mesh);
    EXPECT_EQ(boundary_triangles(mesh), boundary_triangles(c.mesh));
    EXPECT_EQ(volumes(mesh), volumes(c.mesh));
    EXPECT_GE(worst_ratio(mesh, c.metric), std::min(kFloor, worst_ratio(c.mesh, c.metric)) - 1e-12);
    std::uint64_t fresh = 0;
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.id(v) < kFirstId) continue;
      ++fresh;
      EXPECT_TRUE(mesh.is_free(v));
      EXPECT_EQ(mesh.order(v), 1);
    }
    EXPECT_EQ(fresh, added);
    before += count_lacking(c.mesh, c.demand);
    after += count_lacking(mesh, c.demand);
  }
  EXPECT_GT(before, 300U);
  EXPECT_LT(after, before / 2);
}

TEST(InnerVertices, AreAFunctionOfTheMesh) {
  std::mt19937 random(2302);
  for (int i = 0; i < 10; ++i) {
    Case c = random_case(random, i);
    TetMesh mesh = c.mesh, again = c.mesh;
    EXPECT_EQ(add_inner(c, mesh), add_inner(c, again));
    EXPECT_EQ(mesh.sorted_tets(), again.sorted_tets());
    ASSERT_EQ(mesh.vertex_count(), again.vertex_count());
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_EQ(mesh.vertex(v), again.vertex(v));
    }
  }
}

/// With the demand no contraction and no flip takes a tet's last inner vertex; without it some do.
TEST(InnerDemand, SimplifyAndFlipsLeaveNoMoreTetsWithout) {
  std::mt19937 random(2303);
  constexpr double kLow = 0.02;
  std::size_t taken = 0;
  for (int i = 0; i < 40 && !HasFailure(); i += 2) {
    Case c = random_case(random, i);
    add_inner(c, c.mesh);
    const std::size_t before = count_lacking(c.mesh, c.demand);
    const auto lacking_after = [&](const InnerDemand* demand) {
      TetMesh mesh = c.mesh;
      const TetDemands demands{.inner = demand};
      simplify(mesh, c.metric, {.quality_floor = kLow, .inner_quality = kLow, .demands = demands});
      optimise(mesh, c.metric, {.flip_below = 0.9, .quality_floor = kLow, .demands = demands});
      return count_lacking(mesh, c.demand);
    };
    const std::size_t without = lacking_after(nullptr);
    taken += without > before ? without - before : 0;
    EXPECT_LE(lacking_after(&c.demand), before);
  }
  EXPECT_GT(taken, 20U);
}

}  // namespace
}  // namespace mw::test
