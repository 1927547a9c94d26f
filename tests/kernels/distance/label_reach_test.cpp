// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Output to input: what LabelReach proves holds at every point of the triangle.
#include "kernels/distance/label_reach.h"
#include "kernels/distance/interface_fan.h"
#include "kernels/simplify/simplify.h"
#include "tests/kernels/distance/random_points.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

double distance_to_label(const Vec3& x, const SmallVolume& volume, Label label) {
  double best = 1e9;
  const Box3 all{{0, 0, 0}, volume.shape};
  for (Index3 v; v.z < all.hi.z; ++v.z) {
    for (v.y = 0; v.y < all.hi.y; ++v.y) {
      for (v.x = 0; v.x < all.hi.x; ++v.x) {
        if (volume.labels[static_cast<std::size_t>(all.offset(v))] != label) continue;
        const Vec3 lo(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
        const Vec3 near = x.cwiseMax(lo).cwiseMin(lo + Vec3::Ones());
        best = std::min(best, (x - near).norm());
      }
    }
  }
  return best;
}

/// Intervals along each edge of the grid that stands for a triangle.
constexpr int kSteps = 24;

/// Largest distance of a point of the triangle to the nearest of the grid.
double grid_spacing(const std::array<Vec3, 3>& t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[0]).norm(), (t[2] - t[1]).norm()}) / kSteps;
}

/// Largest distance to the farther of two labels over a grid of the triangle.
double farthest(const std::array<Vec3, 3>& t, const SmallVolume& volume) {
  double worst = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const double u = static_cast<double>(i) / kSteps, v = static_cast<double>(j) / kSteps;
      const Vec3 x = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      worst = std::max({worst, distance_to_label(x, volume, 0), distance_to_label(x, volume, 1)});
    }
  }
  return worst;
}

TEST(Promise4Distance, ATriangleThatPassesLiesWithinTheBound) {
  std::mt19937 random(911);
  int passed = 0, passed_near_bound = 0, refused = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    const SmallVolume volume = random_volume_of(random, VolumeKind::kBlobs, {5, 5, 5}, 2);
    const double bound = std::array{0.8, 1.0, 1.5, 2.4}[i % 4];
    const std::int64_t halo = LabelReach::search_reach(bound);
    const LabelBox labels =
        labels_in(volume, {{-halo, -halo, -halo}, {5 + halo, 5 + halo, 5 + halo}});
    const LabelReach reach(labels, bound);
    const Vec3 corner = random_point(random, 3.0);
    const double size = i % 3 == 0 ? 2.0 : 1.0;
    const std::array<Vec3, 3> t{corner, corner + random_point(random, size),
                                corner + random_point(random, size)};
    const double worst = farthest(t, volume);
    if (reach.within(t, 0, 1)) {
      EXPECT_LE(worst, bound);
      ++passed;
      passed_near_bound += worst > 0.8 * bound ? 1 : 0;
    } else {
      EXPECT_GT(worst + grid_spacing(t), 0.9 * bound) << "refused for nothing";
      ++refused;
    }
  }
  EXPECT_GT(passed, 100);
  EXPECT_GT(passed_near_bound, 10);
  EXPECT_GT(refused, 50);
}

TEST(Promise4Distance, TrianglesOfTheStartMeshPassAnyBound) {
  const SmallVolume volume = volume_from({4, 4, 4}, 2, [](auto x, auto, auto) { return x / 2; });
  const LabelBox labels = labels_in(volume, {{-1, -1, -1}, {5, 5, 5}});
  const LabelReach reach(labels, 0.71);
  EXPECT_TRUE(reach.within({Vec3(2, 1, 1), Vec3(2, 2, 1), Vec3(2, 1, 2)}, 0, 1));
  EXPECT_FALSE(reach.within({Vec3(3, 1, 1), Vec3(3, 2, 1), Vec3(3, 1, 2)}, 0, 1));
}

// Interface triangles at a vertex, and the way they face, against those of all tets.

using Fan = std::vector<std::tuple<LocalVertex, LocalVertex, Label, Label, bool>>;

/// Exact: the larger label's tet, with corner `apex`, is on the side of the normal of (v, a, b).
bool faces(const TetMesh& mesh, LocalVertex v, LocalVertex a, LocalVertex b, LocalVertex apex) {
  return volume6(mesh.position(v), mesh.position(a), mesh.position(b), mesh.position(apex)) > 0;
}

/// Lists for every vertex each triangle of the mesh whose two tets have different labels.
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

/// Among 500 labels several share a bit of the signature.
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
