// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Junctions put together from tiles against those of wholes.
#include "engine/verify/junction_ledger.h"
#include "engine/verify/part_links.h"
#include "kernels/audit/topology/parts_union.h"
#include "tests/kernels/audit/topology/mesh_parts_by_owner.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_junctions.h"
#include "tests/temp_folder.h"
#include "tests/testing.h"

namespace mw::engine {
namespace {

using namespace audit::test;

using Side = JunctionLedger::Side;

/// A volume, and a mesh of it with other labels on some tets.
struct Case {
  SmallVolume volume;
  SmallMesh mesh;
};

Case random_case(std::mt19937& random) {
  Case out;
  const auto edge = [&] { return std::int64_t{1 + below(random, 6)}; };
  const auto kind = static_cast<audit::test::VolumeKind>(below(random, audit::test::kVolumeKinds));
  out.volume =
      audit::test::random_volume_of(random, kind, {edge(), edge(), edge()}, 1 + below(random, 6));
  out.mesh = audit::test::five_tet_mesh(out.volume);
  const std::uint32_t rate = 1 + below(random, 20);
  const auto labels = static_cast<std::uint32_t>(out.volume.label_count);
  for (Label& label : out.mesh.labels) {
    if (below(random, rate) == 1) label = below(random, labels);
    if (below(random, 40 * rate) == 1) label = audit::kUnknown;
  }
  return out;
}

audit::Cavities cavities(const audit::PartsPiece& piece, std::size_t labels) {
  audit::PartsUnion parts(labels);
  parts.add(piece);
  return parts.cavities();
}

/// Boxes of voxels with those around the vertices that they own.
void add_tiles(const SmallVolume& volume, std::int64_t edge, JunctionLedger& ledger) {
  const Box3 all{{0, 0, 0}, volume.shape};
  const Index3 last = volume.shape + Index3{1, 1, 1};
  for (std::int64_t z = 0; z < last.z; z += edge) {
    for (std::int64_t y = 0; y < last.y; y += edge) {
      for (std::int64_t x = 0; x < last.x; x += edge) {
        const Box3 owned =
            intersection({{x, y, z}, {x + edge, y + edge, z + edge}}, {{0, 0, 0}, last});
        const Box3 loaded = intersection({owned.lo - Index3{1, 1, 1}, owned.hi}, all);
        std::vector<Label> labels;
        for (Index3 v = loaded.lo; v.z < loaded.hi.z; ++v.z) {
          for (v.y = loaded.lo.y; v.y < loaded.hi.y; ++v.y) {
            for (v.x = loaded.lo.x; v.x < loaded.hi.x; ++v.x) {
              labels.push_back(volume.labels[static_cast<std::size_t>(all.offset(v))]);
            }
          }
        }
        ledger.add(Side::kVolume,
                   audit::voxel_junctions({{loaded.shape(), labels}, volume.shape, loaded, owned},
                                          volume.label_count));
      }
    }
  }
}

void add_shreds(std::mt19937& random, const Case& c, JunctionLedger& ledger) {
  const std::uint32_t tiles = 1 + below(random, 5);
  const auto owner = audit::test::random_owners(random, c.mesh.vertices.size(), tiles);
  for (std::uint32_t tile = 0; tile < tiles; ++tile) {
    const audit::test::OwnedPart part = audit::test::part_of_owner(c.mesh, owner, tile);
    ledger.add(Side::kMesh,
               audit::mesh_junctions(audit::MeshStars(part.view()), c.volume.label_count));
  }
}

TEST(JunctionLedger, TellsWhatTheWholeTellsWhateverTheTiles) {
  std::mt19937 random(31);
  std::size_t changed = 0;
  for (int trial = 0; trial < 250 && !HasFailure(); ++trial) {
    const Case c = random_case(random);
    const std::size_t labels = c.volume.label_count;
    SCOPED_TRACE("trial " + std::to_string(trial) + "\n" + c.volume.text());
    const ::mw::test::TempFolder folder;
    // So little memory that everything goes through the disk, or so much that nothing does.
    JunctionLedger ledger(folder.path(), trial % 2 == 0 ? 4096 : 1 << 20);
    add_shreds(random, c, ledger);
    const audit::MeshStars stars(c.mesh.view());
    ledger.close(Side::kMesh, cavities(audit::mesh_parts(stars, labels).piece, labels));
    add_tiles(c.volume, 1 + trial % 4, ledger);
    ledger.close(Side::kVolume,
                 cavities(audit::voxel_parts(audit::whole(c.volume.view()), labels).piece, labels));
    const audit::JunctionReport tiled = ledger.compare();
    const audit::JunctionReport whole =
        audit::test::compare_junctions(audit::test::junctions_of_volume(c.volume.view(), labels),
                                       audit::test::junctions_of_mesh(c.mesh.view(), labels));
    EXPECT_EQ(tiled.interfaces, whole.interfaces);
    EXPECT_EQ(tiled.meetings, whole.meetings);
    EXPECT_EQ(tiled.interfaces_changed, whole.interfaces_changed);
    EXPECT_EQ(tiled.meetings_changed, whole.meetings_changed);
    changed += whole.meetings_changed.size();
  }
  EXPECT_GT(changed, 500U);
}

// Parts that share items are one, in memory and beyond it.

constexpr std::uint32_t kParts = 40;
constexpr std::size_t kNoMemory = 0;
constexpr std::size_t kAmple = 1 << 20U;

struct ItemRun {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
  std::uint32_t part = 0;
};

std::vector<ItemRun> random_runs(std::mt19937_64& random, std::size_t count) {
  std::vector<ItemRun> out(count);
  for (ItemRun& run : out)
    run = {random() % 400, 1 + random() % 4, static_cast<std::uint32_t>(random() % kParts)};
  return out;
}

/// Components of one label whose parts these runs join.
std::int64_t components(const std::vector<ItemRun>& runs, std::size_t memory_bytes) {
  const test::TempFolder folder;
  PartLinks links(folder.path(), memory_bytes);
  for (const ItemRun& run : runs) links.add(run.first, run.count, run.part);
  audit::PartsUnion parts(1);
  audit::PartsPiece piece;
  piece.part_class.assign(kParts, 0);
  parts.add(std::move(piece));
  links.unite(parts);
  return parts.betti_of_volume()[0].open.b0;
}

bool share_an_item(const ItemRun& a, const ItemRun& b) {
  return a.first < b.first + b.count && b.first < a.first + a.count;
}

/// Finds the same by comparing all with all.
std::int64_t components_by_force(const std::vector<ItemRun>& runs) {
  std::vector<std::uint32_t> name(kParts);
  for (std::uint32_t part = 0; part < kParts; ++part) name[part] = part;
  for (const ItemRun& a : runs) {
    for (const ItemRun& b : runs) {
      const std::uint32_t old = name[a.part];
      const std::uint32_t other = name[b.part];
      if (share_an_item(a, b)) std::replace(name.begin(), name.end(), old, other);
    }
  }
  return std::ssize(std::set<std::uint32_t>(name.begin(), name.end()));
}

TEST(PartLinks, JoinPartsThatShareItemsWhateverTheMemory) {
  std::mt19937_64 random(1);
  std::set<std::int64_t> seen;
  for (int round = 0; round < 200; ++round) {
    const std::vector<ItemRun> runs = random_runs(random, random() % 60);
    const std::int64_t expected = components_by_force(runs);
    EXPECT_EQ(components(runs, kAmple), expected) << round;
    EXPECT_EQ(components(runs, kNoMemory), expected) << round;
    seen.insert(expected);
  }
  EXPECT_GT(seen.size(), 10U);
}

TEST(PartLinks, NeighboursAreNotJoined) {
  for (const std::size_t memory : {kNoMemory, kAmple}) {
    EXPECT_EQ(components({{0, 5, 0}, {5, 5, 1}, {10, 1, 2}}, memory), kParts);
    EXPECT_EQ(components({{0, 6, 0}, {5, 5, 1}, {9, 1, 2}}, memory), kParts - 2);
  }
}

}  // namespace
}  // namespace mw::engine
