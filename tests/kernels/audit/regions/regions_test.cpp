// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Betti numbers from a label's own tets against those that see the whole box.
#include "kernels/audit/regions/regions.h"

#include "tests/kernels/audit/topology/mesh_parts_by_owner.h"
#include "tests/kernels/audit/topology/random_labels.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_audit.h"
#include "tests/testing.h"

namespace mw::audit {

void PrintTo(const RegionBetti& betti, std::ostream* out);  // in betti_test.cpp

namespace {

using namespace test;

std::vector<RegionBetti> without_exterior(std::vector<RegionBetti> rows) {
  rows.pop_back();
  return rows;
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
    test::paint_in_runs(random, labels, runs, mesh);
    ASSERT_EQ(region_betti(mesh.view(), labels), without_exterior(mesh_betti(mesh.view(), labels)))
        << trial;
  }
}

/// Random labels on the tets of a mesh, some of them left out, some damaged.
SmallMesh random_mesh(std::mt19937& random, std::uint32_t labels) {
  SmallVolume v = random_volume(random);
  SmallMesh mesh = five_tet_mesh(v);
  for (Label& label : mesh.labels) {
    label = below(random, 3) == 0 ? below(random, labels + 1) : label % labels;
    if (label == labels) label = kUnknown;
  }
  const auto some = [&] { return below(random, static_cast<std::uint32_t>(mesh.tets.size())); };
  for (std::uint32_t i = below(random, 3); i > 0; --i) {
    mesh.tets.push_back(mesh.tets[some()]);
    mesh.labels.push_back(below(random, labels));
  }
  for (std::uint32_t i = below(random, 2); i > 0; --i) mesh.tets[some()][2] = mesh.tets[some()][1];
  std::vector<bool> kept;
  for (std::uint32_t l = 0; l < labels; ++l) kept.push_back(below(random, 4) != 0);
  for (Label& label : mesh.labels) {
    if (label == kUnknown) label = labels;
  }
  kept.push_back(true);
  return kept_part(mesh, kept);
}

/// Joins pieces with maps.
std::vector<RegionBetti> joined(const std::vector<RegionsPiece>& pieces, std::size_t labels) {
  RegionsUnion regions(labels);
  std::multimap<std::uint64_t, std::uint32_t> items;
  std::map<std::uint64_t, std::vector<RegionsPiece::Meeting>> meetings;
  for (const RegionsPiece& piece : pieces) {
    const std::uint32_t first = regions.add(piece);
    for (const auto& [item, set] : piece.shared) items.emplace(item, first + set);
    for (const auto& [vertex, part, inner] : piece.meetings) {
      meetings[vertex].push_back({vertex, first + part, first + inner});
    }
  }
  for (const auto& [item, set] : items) regions.unite(items.find(item)->second, set);
  for (auto& [vertex, here] : meetings) regions.meet(here);
  return regions.betti();
}

TEST(RegionBetti, IsThatOfTheWholeWhateverVerticesATileOwns) {
  std::mt19937 random(13);
  std::size_t meetings = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const std::uint32_t labels = 1 + below(random, 4);
    const SmallMesh mesh = random_mesh(random, labels);
    const std::uint32_t tiles = 1 + below(random, 5);
    const auto owner = test::random_owners(random, mesh.vertices.size(), tiles);
    std::vector<RegionsPiece> pieces;
    for (std::uint32_t tile = 0; tile < tiles; ++tile) {
      const test::OwnedPart part = test::part_of_owner(mesh, owner, tile);
      const MeshStars stars(part.view());
      pieces.push_back(regions_of(stars, labels));
      meetings += pieces.back().meetings.size();
    }
    ASSERT_EQ(joined(pieces, labels), region_betti(mesh.view(), labels)) << trial;
  }
  EXPECT_GT(meetings, 1000U);
}

}  // namespace
}  // namespace mw::audit
