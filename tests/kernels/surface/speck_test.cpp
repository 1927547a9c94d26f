// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes of parts of a few voxels, against sums over all tets.
#include "kernels/surface/speck.h"

#include <algorithm>

#include "tests/kernels/surface/interface_triangles.h"

namespace mw::test {
namespace {

/// A part of some voxels in a row or around a corner, and a voxel that touches one of them by an
/// edge alone, all of label 1.
struct Parts {
  Parts(std::mt19937& random, int count) : volume{{12, 12, 12}, 2, {}}, voxels(count) {
    volume.labels.assign(12 * 12 * 12, 0);
    Index3 at{5, 5, 5};
    for (int i = 0; i < voxels; ++i) {
      put(at);
      at = at + (below(random, 2) == 0 ? Index3{1, 0, 0} : Index3{0, 1, 0});
    }
    put({4, 5, 4});
  }
  void put(Index3 v) {
    const Box3 all{{0, 0, 0}, volume.shape};
    volume.labels[static_cast<std::size_t>(all.offset(v))] = 1;
  }

  SmallVolume volume;
  int voxels = 0;
};

/// The volume of the tets of label 1, in voxels.
double volume_of_label(const TetMesh& mesh) {
  double sum = 0.0;
  for (const LocalTet& t : mesh.tets()) {
    if (t.label != 1) continue;
    const auto& [a, b, c, d] = t.vertices;
    sum += static_cast<double>(
        volume6(mesh.position(a), mesh.position(b), mesh.position(c), mesh.position(d)));
  }
  return sum / (6.0 * kUnitsPerVoxel * kUnitsPerVoxel * kUnitsPerVoxel);
}

TEST(SpeckMeasure, IsTheVolumeOfEachPartAsAShareOfItsVoxels) {
  std::mt19937 random(81);
  int parts = 0, of_two = 0;
  for (int i = 0; i < 12; ++i) {
    const Parts made(random, 1 + i % 3);
    const Metric metric = i % 2 == 0 ? Metric() : Metric({1.0, 2.0, 1.5});
    GuardedMesh guarded(made.volume, 1.5);
    TetMesh& mesh = guarded.mesh;
    SpeckMeasure measure;
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (!mesh.is_alive(v) || !mesh.is_free(v)) continue;
      const auto found = measure.at(mesh, metric, v, 1, guarded.labels);
      const std::vector<SpeckVolume> before(found.begin(), found.end());
      for (const SpeckVolume& s : before) EXPECT_NEAR(s.share, 1.0, 1e-12);
      EXPECT_LE(before.size(), 2);
      if (before.empty()) continue;
      of_two += before.size() == 2 ? 1 : 0;
      const double volume = volume_of_label(mesh);
      const Point start = mesh.position(v), moved{start.x + 90, start.y - 60, start.z + 30};
      const Vec3 way = metric.vector(start, moved);
      mesh.move(v, moved, mesh.quadric(v));
      const auto after = measure.at(mesh, metric, v, 1, guarded.labels);
      ASSERT_EQ(after.size(), before.size());
      for (std::size_t k = 0; k < before.size(); ++k) {
        EXPECT_NEAR(after[k].share, before[k].share + before[k].slope.dot(way), 1e-9);
      }
      if (before.size() == 1) {
        // It is one of the two parts.
        const double change = volume_of_label(mesh) - volume, grown = after[0].share - 1.0;
        EXPECT_LT(std::min(std::abs(change - grown * made.voxels), std::abs(change - grown)), 1e-9);
      }
      mesh.move(v, start, mesh.quadric(v));
      ++parts;
    }
  }
  EXPECT_GT(parts, 100);
  EXPECT_GT(of_two, 10);
}

/// Nothing is found for a part of four voxels and for a label that fills the rest; the single voxel
/// beside them is found.
TEST(SpeckMeasure, LeavesOutWhatIsLarge) {
  std::mt19937 random(82);
  const Parts made(random, 4);
  GuardedMesh guarded(made.volume, 1.5);
  SpeckMeasure measure;
  int found = 0;
  for (LocalVertex v = 0; v < guarded.mesh.vertex_count(); ++v) {
    if (!guarded.mesh.is_alive(v) || !guarded.mesh.is_free(v)) continue;
    EXPECT_TRUE(measure.at(guarded.mesh, Metric(), v, 0, guarded.labels).empty());
    const auto specks = measure.at(guarded.mesh, Metric(), v, 1, guarded.labels);
    const Point p = guarded.mesh.position(v), single{4608, 5632, 4608};
    const bool is_at_single = std::abs(p.x - single.x) <= 512 && std::abs(p.y - single.y) <= 512 &&
                              std::abs(p.z - single.z) <= 512;
    EXPECT_LE(specks.size(), is_at_single ? 1 : 0);
    found += static_cast<int>(specks.size());
  }
  EXPECT_EQ(found, 8);
}

}  // namespace
}  // namespace mw::test
