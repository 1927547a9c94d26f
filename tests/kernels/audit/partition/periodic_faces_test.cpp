// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opposite sides of meshes of cubes, which differ where the pattern of cubes does.
#include "kernels/audit/partition/periodic_faces.h"

#include <random>
#include <set>

#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::audit {
namespace {

using test::five_tet_mesh;
using test::SmallMesh;
using test::volume_from;

constexpr unsigned kAllAxes = 7;

/// The triangles on a side by brute force.
std::set<std::set<std::array<double, 2>>> side_of(const SmallMesh& mesh, unsigned axis, double at) {
  std::set<std::set<std::array<double, 2>>> out;
  for (const TetRow& tet : mesh.tets) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::set<std::array<double, 2>> corners;
      for (std::size_t i = 0; i < 4; ++i) {
        const Position& p = mesh.vertices[tet[i]];
        if (i != left_out && p[axis] == at) corners.insert({p[(axis + 1) % 3], p[(axis + 2) % 3]});
      }
      if (corners.size() == 3) out.insert(corners);
    }
  }
  return out;
}

TEST(PeriodicFaces, AreThoseThatBruteForceFinds) {
  std::mt19937 random(5);
  int alike = 0, different = 0;
  for (const Index3 shape : {Index3{2, 4, 2}, Index3{3, 2, 4}, Index3{1, 3, 2}, Index3{5, 3, 1}}) {
    const auto cubes = volume_from(shape, 1, [](auto, auto, auto) { return 0; });
    SmallMesh mesh = five_tet_mesh(cubes);
    for (int round = 0; round < 5; ++round) {
      if (round > 0) {  // any vertex goes along y, which no tet minds here
        mesh.vertices[random() % mesh.vertices.size()][1] += 1.0 / 4096;
      }
      const FaceTally tally = tally_faces({.mesh = mesh.view()}, {}, shape, kAllAxes);
      const std::array<std::int64_t, 3> ends{shape.x, shape.y, shape.z};
      for (const unsigned axis : {0U, 1U, 2U}) {
        const auto low = side_of(mesh, axis, 0),
                   high = side_of(mesh, axis, static_cast<double>(ends[axis]));
        EXPECT_EQ(tally.sides(axis)[0].triangles, low.size());
        EXPECT_EQ(tally.sides(axis)[1].triangles, high.size());
        EXPECT_EQ(periodic_check(tally, 1U << axis).passed, low == high);
        (low == high ? alike : different) += 1;
      }
    }
  }
  EXPECT_GT(alike, 5);
  EXPECT_GT(different, 20);
}

TEST(PeriodicFaces, TilesAddUp) {
  const auto cubes = volume_from({4, 4, 4}, 1, [](auto, auto, auto) { return 0; });
  const SmallMesh mesh = five_tet_mesh(cubes);
  const FaceTally whole = tally_faces({.mesh = mesh.view()}, {}, {4, 4, 4}, kAllAxes);
  std::vector<std::uint8_t> owned(mesh.vertices.size()), others(mesh.vertices.size());
  for (std::size_t v = 0; v < owned.size(); ++v) (v % 3 == 0 ? owned : others)[v] = 1;
  FaceTally sum;
  for (const auto& part : {owned, others}) {
    sum.add(tally_faces({.mesh = mesh.view(), .vertex_ids = {}, .tet_ids = {}, .owned = part}, {},
                        {4, 4, 4}, kAllAxes));
  }
  for (const unsigned axis : {0U, 1U, 2U}) EXPECT_EQ(sum.sides(axis), whole.sides(axis));
  EXPECT_TRUE(periodic_check(whole, kAllAxes).passed);
}

}  // namespace
}  // namespace mw::audit
