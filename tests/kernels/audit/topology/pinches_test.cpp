// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// P1: pinches of volumes and meshes against maps of all faces, whole and by tiles.
#include "tests/oracle/pinches.h"

#include "kernels/audit/audit.h"
#include "kernels/audit/topology/parts_union.h"
#include "kernels/audit/topology/pinches.h"
#include "tests/kernels/audit/topology/mesh_parts_by_owner.h"
#include "tests/kernels/audit/topology/random_labels.h"
#include "tests/testing.h"

namespace mw::audit {
namespace {

using namespace test;

std::vector<Pinches> counts(const PinchedByLabel& pinched, std::size_t label_count) {
  std::vector<Pinches> out(label_count);
  for (const auto& [label, found] : pinched) {
    if (label < label_count) out[label] = {found.vertices.size(), found.edges.size()};
  }
  return out;
}

std::vector<Pinches> of_voxels(const VoxelTile& tile, std::size_t label_count) {
  std::vector<Pinches> out;
  for (const VoxelPinches& p : voxel_parts(tile, label_count).pinches) {
    out.push_back(p.in_layers({1, 1, 1}));
  }
  return out;
}

void add(const std::vector<Pinches>& some, std::vector<Pinches>& sum) {
  for (std::size_t label = 0; label < sum.size(); ++label) sum[label].add(some[label]);
}

SmallVolume any_volume(std::mt19937& random) {
  return below(random, 3) == 0 ? random_volume(random)
                               : random_volume_of(random, random_kind(random),
                                                  random_shape(random, 1, 7), 1 + below(random, 5));
}

TEST(VoxelPinches, AgreeWithTheDefinition) {
  std::mt19937 random(31);
  std::uint64_t edges = 0, vertices = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const SmallVolume v = any_volume(random);
    const auto expected = counts(pinches_of(v.view()), v.label_count);
    ASSERT_EQ(of_voxels(whole(v.view()), v.label_count), expected) << v.text();
    for (const Pinches& p : expected) {
      edges += p.edges;
      vertices += p.vertices;
    }
  }
  EXPECT_GT(edges, 1000U);
  EXPECT_GT(vertices, edges);
}

/// A tile owns a box of vertices and has loaded the voxels around these.
TEST(VoxelPinches, OfTilesAddUp) {
  std::mt19937 random(32);
  for (int trial = 0; trial < 300; ++trial) {
    const SmallVolume v = any_volume(random);
    const Index3 step = random_shape(random, 1, 4);
    const Box3 all{{0, 0, 0}, v.shape};
    std::vector<Pinches> sum(v.label_count);
    Index3 lo;
    for (lo.z = 0; lo.z <= v.shape.z; lo.z += step.z) {
      for (lo.y = 0; lo.y <= v.shape.y; lo.y += step.y) {
        for (lo.x = 0; lo.x <= v.shape.x; lo.x += step.x) {
          const Box3 owned = intersection({lo, lo + step}, {{0, 0, 0}, v.shape + Index3{1, 1, 1}});
          const Box3 loaded = intersection({lo - Index3{1, 1, 1}, lo + step}, all);
          std::vector<Label> labels;
          for_each_index(loaded, [&](Index3 at) {
            labels.push_back(v.labels[static_cast<std::size_t>(all.offset(at))]);
          });
          add(of_voxels({{loaded.shape(), labels}, v.shape, loaded, owned}, v.label_count), sum);
        }
      }
    }
    ASSERT_EQ(sum, counts(pinches_of(v.view()), v.label_count)) << v.text();
  }
}

/// Voxels that are cut into layers are a volume of more voxels.
TEST(VoxelPinches, InLayersAreThoseOfTheFinerVolume) {
  std::mt19937 random(33);
  for (int trial = 0; trial < 200; ++trial) {
    const SmallVolume v = any_volume(random);
    const Index3 layers = random_shape(random, 1, 3);
    const Box3 all{{0, 0, 0}, v.shape};
    const Index3 shape{v.shape.x * layers.x, v.shape.y * layers.y, v.shape.z * layers.z};
    const SmallVolume finer = volume_from(shape, v.label_count, [&](auto x, auto y, auto z) {
      return v
          .labels[static_cast<std::size_t>(all.offset({x / layers.x, y / layers.y, z / layers.z}))];
    });
    const auto expected = counts(pinches_of(finer.view()), v.label_count);
    const auto found = voxel_parts(whole(v.view()), v.label_count).pinches;
    for (std::size_t label = 0; label < v.label_count; ++label) {
      ASSERT_EQ(found[label].in_layers(layers), expected[label]) << v.text();
    }
  }
}

TEST(MeshPinches, AgreeWithTheDefinitionWhateverTheTiles) {
  std::mt19937 random(34);
  std::uint64_t edges = 0, vertices = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const SmallVolume v = random_volume(random);
    SmallMesh mesh = five_tet_mesh(v);
    if (trial % 2 == 0) paint_in_runs(random, static_cast<std::uint32_t>(v.label_count), 3, mesh);
    const auto expected = counts(pinches_of(mesh.view()), v.label_count);
    ASSERT_EQ(mesh_pinches(MeshStars(mesh.view()), v.label_count), expected) << v.text();
    const auto owners = random_owners(random, mesh.vertices.size(), 3);
    std::vector<Pinches> sum(v.label_count);
    for (std::uint32_t tile = 0; tile < 3; ++tile) {
      const OwnedPart part = part_of_owner(mesh, owners, tile);
      add(mesh_pinches(MeshStars(part.view()), v.label_count), sum);
    }
    ASSERT_EQ(sum, expected) << v.text();
    for (const Pinches& p : expected) {
      edges += p.edges;
      vertices += p.vertices;
    }
  }
  EXPECT_GT(edges, 1000U);
  EXPECT_GT(vertices, 1000U);
}

TEST(MeshPinches, OfLabelsThatWereLeftOutDoNotMatter) {
  std::mt19937 random(35);
  for (int trial = 0; trial < 100; ++trial) {
    const SmallVolume v = random_volume(random);
    const SmallMesh mesh = five_tet_mesh(v);
    const auto all = mesh_pinches(MeshStars(mesh.view()), v.label_count);
    KeptLabels kept(v.label_count, false);
    kept[0] = true;
    const SmallMesh part = kept_part(mesh, kept);
    ASSERT_EQ(mesh_pinches(MeshStars(part.view()), v.label_count)[0], all[0]) << v.text();
  }
}

TEST(Pinches, OfHalvedEdgesAreMoreEdgesAndTheirMiddles) {
  const Pinches path{.vertices = 4, .edges = 3};
  EXPECT_EQ(path.halved(0), path);
  EXPECT_EQ(path.halved(1), (Pinches{7, 6}));
  EXPECT_EQ(path.halved(2), (Pinches{13, 12}));
}

bool passes(const LabelPinches& pinches, std::optional<int> halvings, bool is_kept = true) {
  AuditFindings findings{.voxels = {{}, {}}, .mesh = {{}, {}}, .pinches = {pinches}};
  findings.validity.checks = {{"P2 input", true, ""}};
  AuditOptions options{.halvings = halvings};
  if (!is_kept) options.kept = {false};
  const AuditReport report = judge(std::move(findings), options);
  const auto found = std::find_if(report.checks.begin(), report.checks.end(),
                                  [](const Check& c) { return c.name == "P1 pinches"; });
  EXPECT_EQ(report.pinches.mesh, is_kept ? pinches.mesh : Pinches{});
  return found->passed;
}

TEST(Pinches, AreNotToBeMoreThanThoseOfVoxels) {
  const Pinches none, corner{1, 0}, path{3, 2}, longer{4, 3}, halves{5, 4};
  for (const std::optional<int> halvings : {std::optional<int>{}, std::optional<int>{0}}) {
    EXPECT_TRUE(passes({none, none}, halvings));
    EXPECT_TRUE(passes({path, corner}, halvings));
    EXPECT_FALSE(passes({none, corner}, halvings));
    EXPECT_FALSE(passes({corner, path}, halvings));
    EXPECT_TRUE(passes({corner, path}, halvings, false));
  }
  EXPECT_TRUE(passes({path, longer}, std::nullopt)) << "edges of others are as short as they like";
  EXPECT_FALSE(passes({path, longer}, 0));
  EXPECT_TRUE(passes({path, halves}, 1));
  EXPECT_FALSE(passes({path, Pinches{6, 4}}, 1));
  EXPECT_FALSE(passes({path, Pinches{5, 5}}, 1));
}

}  // namespace
}  // namespace mw::audit
