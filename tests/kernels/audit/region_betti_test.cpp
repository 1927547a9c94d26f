// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Betti numbers from a label's own tets against those that see the whole box.
#include "kernels/audit/region_betti.h"

#include <gtest/gtest.h>

#include "tests/oracle/small_volumes.h"

namespace mw::audit {

void PrintTo(const RegionBetti& betti, std::ostream* out);  // in betti_test.cpp

namespace {

using test::below;
using test::five_tet_mesh;
using test::random_volume;
using test::SmallMesh;
using test::SmallVolume;

std::vector<RegionBetti> without_exterior(std::vector<RegionBetti> rows) {
  rows.pop_back();
  return rows;
}

/// The mesh without the tets of some labels.
SmallMesh kept_part(const SmallMesh& mesh, const std::vector<bool>& kept) {
  SmallMesh out{mesh.vertices, {}, {}};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!kept[mesh.labels[t]]) continue;
    out.tets.push_back(mesh.tets[t]);
    out.labels.push_back(mesh.labels[t]);
  }
  return out;
}

TEST(RegionBetti, AgreesWithVoxelsWhateverIsLeftOut) {
  std::mt19937 random(11);
  int pinched = 0, hollow = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const SmallVolume v = random_volume(random);
    auto expected = without_exterior(voxel_betti(v.view(), v.label_count));
    const SmallMesh mesh = five_tet_mesh(v);
    ASSERT_EQ(region_betti(mesh.view(), v.label_count), expected) << v.text();
    std::vector<bool> kept;
    for (std::size_t l = 0; l < v.label_count; ++l) {
      kept.push_back(below(random, 2) == 0);
      if (!kept.back()) expected[l] = {};
      pinched += expected[l].closed != expected[l].open ? 1 : 0;
      hollow += expected[l].closed.b2 > 0 ? 1 : 0;
    }
    const SmallMesh part = kept_part(mesh, kept);
    ASSERT_EQ(region_betti(part.view(), v.label_count), expected) << v.text();
  }
  EXPECT_GT(pinched, 500);
  EXPECT_GT(hollow, 100);
}

/// Labels of single tets meet themselves in edges and vertices in every way there is.
TEST(RegionBetti, AgreesWithTheWholeMeshOfRandomlyLabelledTets) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 3000; ++trial) {
    SmallVolume v = random_volume(random);
    v.labels.assign(v.labels.size(), 0);
    SmallMesh mesh = five_tet_mesh(v, {.spacing = {1, 0.7, 2.3}, .origin = {0.1, -5, 3}});
    const std::uint32_t labels = 1 + below(random, 6);
    const std::uint32_t runs = 1 + below(random, 6);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const bool again = t > 0 && below(random, runs) != 0;
      const Label fresh = below(random, labels + 1);
      mesh.labels[t] = again ? mesh.labels[t - 1] : fresh < labels ? fresh : kUnknown;
    }
    ASSERT_EQ(region_betti(mesh.view(), labels), without_exterior(mesh_betti(mesh.view(), labels)))
        << trial;
  }
}

}  // namespace
}  // namespace mw::audit
