// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Surfaces whose touching parts are moved apart: manifolds for readers that join equal places, of
// the same shape, with parts in their own tets and holes in their own holes.
#include <gmock/gmock.h>

#include "io/surface/surface_facts.h"
#include "kernels/core/vector3.h"
#include "tests/io/surface/collected_surface.h"

namespace mw::io {
namespace {

using FloatPlace = std::array<float, 3>;

FloatPlace float_place(const Position& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

Position normal_of(const CollectSurface& surface, const Triangle& t) {
  return cross(minus(surface.vertices[t[1]], surface.vertices[t[0]]),
               minus(surface.vertices[t[2]], surface.vertices[t[0]]));
}

SurfaceFacts facts_of(Surface surface, Joined joined) {
  const TempDir dir;
  CollectSurface out;
  SurfaceFactsSink facts(out, joined, dir.path());
  surface.write(facts);
  return facts.facts();
}

class ApartPlaces : public testing::TestWithParam<unsigned> {};

TEST_P(ApartPlaces, AreAManifoldWherePlacesAreJoined) {
  const MeshData data = touching_mesh(GetParam());
  SurfaceMesh mesh(data);
  const ShellPlans plans(mesh.mesh(), true);
  std::size_t moved = 0;
  for (Label rank = 0; rank < mesh.mesh().table().size(); ++rank) {
    const std::vector<ShellPlan> plan{plans.of_label(rank)};
    const CollectSurface doubled = mesh.collect(plan, Touching::kDoubled);
    const CollectSurface apart = mesh.collect(plan, Touching::kApart);
    const SurfaceFacts facts = facts_of(mesh.surface(plan, Touching::kApart), Joined::kByPlace);
    EXPECT_TRUE(facts.is_closed() && facts.is_manifold());
    EXPECT_NEAR(facts.volume / (enclosed6(doubled) / 6), 1, 0.02);
    ASSERT_EQ(apart.triangles, doubled.triangles);
    std::set<FloatPlace> places;
    for (std::size_t v = 0; v < apart.vertices.size(); ++v) {
      places.insert(float_place(apart.vertices[v]));
      const double way = norm(minus(apart.vertices[v], doubled.vertices[v]));
      EXPECT_LE(way, 1.0 / 64);  // edges have a length of 1 at least
      if (way > 0) ++moved;
    }
    EXPECT_EQ(places.size(), apart.vertices.size());
    for (const Triangle& t : apart.triangles) {
      const Position before = normal_of(doubled, t), after = normal_of(apart, t);
      EXPECT_GT(dot(before, after), 0.99 * norm(before) * norm(after));
    }
  }
  EXPECT_GT(moved, 0U);
}

TEST_P(ApartPlaces, LeaveVerticesWithoutACopyWhereTheyAre) {
  SurfaceMesh mesh(touching_mesh(GetParam()));
  const ShellPlans plans(mesh.mesh(), true);
  const CollectSurface doubled = mesh.collect({plans.of_label(0)}, Touching::kDoubled);
  const CollectSurface apart = mesh.collect({plans.of_label(0)}, Touching::kApart);
  std::map<Position, int> copies;
  for (const Position& p : doubled.vertices) ++copies[p];
  for (std::size_t v = 0; v < apart.vertices.size(); ++v) {
    const bool is_moved = apart.vertices[v] != doubled.vertices[v];
    EXPECT_EQ(is_moved, copies.at(doubled.vertices[v]) > 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ApartPlaces, testing::Range(0U, 24U));

/// Whether a place is inside the tet of these corners, not on it.
bool is_inside(const MeshData& mesh, const TetRows& tet, const Position& place) {
  std::array<Position, 4> corners{};
  for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.vertices[tet[i]];
  const auto side = [](const std::array<Position, 4>& c) {
    return volume6(c[0], c[1], c[2], c[3]) > 0;
  };
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<Position, 4> other = corners;
    other[i] = place;
    if (side(other) != side(corners)) return false;
  }
  return true;
}

/// Two tets of label 1, all around them being 0, and the rows that both have.
struct TouchingTets {
  MeshData mesh;
  std::array<TetRows, 2> tets;
  std::vector<std::uint64_t> shared;
};

std::vector<std::uint64_t> shared_rows(const std::array<TetRows, 2>& tets) {
  std::vector<std::uint64_t> out;
  for (const std::uint64_t row : tets[0]) {
    if (std::count(tets[1].begin(), tets[1].end(), row) > 0) out.push_back(row);
  }
  return out;
}

/// Returns tets inside of the grid that share a corner, or the two of an edge, and nothing else.
TouchingTets touching_tets(std::size_t corners) {
  TouchingTets out{.mesh = grid_mesh({4, 4, 4}, 1), .tets = {}, .shared = {}};
  std::fill(out.mesh.labels.begin(), out.mesh.labels.end(), RawLabel{0});
  const auto is_inner = [&](const TetRows& tet) {
    return std::all_of(tet.begin(), tet.end(), [&](std::uint64_t row) {
      const Position& p = out.mesh.vertices[row];
      return std::all_of(p.begin(), p.end(), [](double x) { return x > 0 && x < 4; });
    });
  };
  for (std::size_t a = 0; a < out.mesh.tets.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      out.tets = {out.mesh.tets[a], out.mesh.tets[b]};
      if (!is_inner(out.tets[0]) || !is_inner(out.tets[1])) continue;
      out.shared = shared_rows(out.tets);
      if (out.shared.size() != corners) continue;
      out.mesh.labels[a] = out.mesh.labels[b] = 1;
      return out;
    }
  }
  return out;
}

/// Where copies of shared vertices are moved to, from the outside or from the inside.
void expect_inside_of_tets(Label rank) {
  for (const std::size_t corners : {1U, 2U}) {
    const TouchingTets touching = touching_tets(corners);
    ASSERT_EQ(touching.shared.size(), corners);
    SurfaceMesh mesh(touching.mesh);
    const ShellPlans plans(mesh.mesh(), true);
    const CollectSurface doubled = mesh.collect({plans.of_label(rank)}, Touching::kDoubled);
    const CollectSurface apart = mesh.collect({plans.of_label(rank)}, Touching::kApart);
    std::array<std::size_t, 2> found{};
    for (std::size_t v = 0; v < apart.vertices.size(); ++v) {
      if (apart.vertices[v] == doubled.vertices[v]) continue;
      for (std::size_t t = 0; t < 2; ++t) {
        if (is_inside(touching.mesh, touching.tets[t], apart.vertices[v])) ++found[t];
      }
    }
    EXPECT_EQ(found[0], corners);
    EXPECT_EQ(found[1], corners);
  }
}

TEST(ApartPlacesOfTets, AreInsideOfThePartsThatTouch) {
  expect_inside_of_tets(1);
}

TEST(ApartPlacesOfTets, AreInsideOfTheHolesThatTouch) {
  expect_inside_of_tets(0);
}

/// Far from 0 a 128th of a height is less than what 32 bits tell apart.
TEST(ApartPlacesOfTets, AreApartInThirtyTwoBits) {
  for (const double far : {1e3, 2e4, 1e5, 2e5}) {
    MeshData data = touching_mesh(1);
    for (Position& p : data.vertices) p[0] += far;
    SurfaceMesh mesh(data);
    const ShellPlans plans(mesh.mesh(), true);
    for (Label rank = 0; rank < mesh.mesh().table().size(); ++rank) {
      const SurfaceFacts facts =
          facts_of(mesh.surface({plans.of_label(rank)}, Touching::kApart), Joined::kByPlace);
      EXPECT_TRUE(facts.is_closed() && facts.is_manifold()) << far;
    }
  }
}

}  // namespace
}  // namespace mw::io
