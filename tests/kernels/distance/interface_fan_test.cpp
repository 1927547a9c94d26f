// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Interface triangles at a vertex, and the way they face, against those of all tets.
#include "kernels/distance/interface_fan.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "kernels/simplify/simplify.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

using Fan = std::vector<std::tuple<LocalVertex, LocalVertex, Label, Label, bool>>;

/// Exact: the larger label's tet, with corner `apex`, is on the side of the normal of (v, a, b).
bool faces(const TetMesh& mesh, LocalVertex v, LocalVertex a, LocalVertex b, LocalVertex apex) {
  return volume6(mesh.position(v), mesh.position(a), mesh.position(b), mesh.position(apex)) > 0;
}

/// Returns for every vertex the triangles of the mesh whose two tets have different labels.
std::vector<Fan> fans_of_all_tets(const TetMesh& mesh) {
  std::map<std::set<LocalVertex>, std::map<Label, LocalVertex>> triangles;
  for (const LocalTet& t : mesh.tets()) {
    for (LocalVertex opposite : t.vertices) {
      std::set<LocalVertex> corners(t.vertices.begin(), t.vertices.end());
      corners.erase(opposite);
      triangles[corners][t.label] = opposite;
    }
  }
  std::vector<Fan> fans(mesh.vertex_count());
  for (const auto& [corners, apexes] : triangles) {
    if (apexes.size() < 2) continue;
    for (LocalVertex v : corners) {
      std::set<LocalVertex> others = corners;
      others.erase(v);
      const LocalVertex a = *others.begin(), b = *others.rbegin();
      const auto& [low, below] = *apexes.begin();
      const auto& [high, above] = *apexes.rbegin();
      const bool faces_high = faces(mesh, v, a, b, above);
      EXPECT_NE(faces_high, faces(mesh, v, a, b, below));
      fans[v].emplace_back(a, b, low, high, faces_high);
    }
  }
  for (Fan& fan : fans) std::sort(fan.begin(), fan.end());
  return fans;
}

void expect_fans(const TetMesh& mesh) {
  const std::vector<Fan> expected = fans_of_all_tets(mesh);
  InterfaceFan fan;
  std::vector<FanTriangle> found;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || !mesh.is_free(v)) continue;
    fan.collect(mesh, v, found);
    Fan listed;
    for (const FanTriangle& t : found) {
      listed.emplace_back(t.a, t.b, t.low, t.high, t.faces_high);
    }
    ASSERT_EQ(listed, expected[v]) << v;
  }
}

/// Before and after contractions.
void expect_fans_throughout(TetMesh mesh) {
  expect_fans(mesh);
  simplify(mesh, Metric(), {});
  expect_fans(mesh);
}

/// With 500 labels several share a bit of the signature.
TEST(InterfaceFan, IsThatOfAllTets) {
  std::mt19937 random(615);
  for (const std::uint32_t labels : {1U, 2U, 3U, 20U, 500U}) {
    for (std::uint32_t kind = 0; kind < audit::test::kVolumeKinds && !HasFailure(); ++kind) {
      const auto volume = [&] {
        return random_volume_of(random, static_cast<VolumeKind>(kind), {6, 6, 5}, labels);
      };
      expect_fans_throughout(dense_mesh(volume()));
      expect_fans_throughout(dense_cutout(volume(), {{1, 0, 1}, {5, 4, 5}}));
    }
  }
}

}  // namespace
}  // namespace mw::test
