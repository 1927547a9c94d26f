// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells fall into tets that fill them, and neighbours cut their common face alike.
#include <bit>

#include "kernels/core/lattice.h"
#include "kernels/quality/quality.h"
#include "kernels/start/cells/cell_levels.h"
#include "kernels/start/cells/cell_template.h"
#include "tests/kernels/start/cells/large_cells.h"
#include "tests/kernels/start/coarsen/coarse_volume.h"

namespace mw::test {
namespace {

Point point_of(CellNode n) {
  return {static_cast<std::int32_t>(n % 3), static_cast<std::int32_t>(n / 3 % 3),
          static_cast<std::int32_t>(n / 9)};
}

std::int64_t size6(const NodeTet& t) {
  return std::abs(volume6(point_of(t[0]), point_of(t[1]), point_of(t[2]), point_of(t[3])));
}

/// How many of the node's coordinates are in the middle: 0 for corners up to 3 for the centre.
int middles_of(CellNode n) {
  const Point p = point_of(n);
  return (p.x == 1 ? 1 : 0) + (p.y == 1 ? 1 : 0) + (p.z == 1 ? 1 : 0);
}

/// Corners, and some of the middles of edges and faces.
CellNodes random_nodes(std::mt19937& random) {
  const unsigned rarity = 1 + random() % 4;
  CellNodes nodes = kCellCorners;
  for (CellNode n = 0; n < 27; ++n) {
    const int middles = middles_of(n);
    if ((middles == 1 || middles == 2) && random() % (rarity + 1) == 0) nodes |= 1U << n;
  }
  return nodes;
}

template <std::size_t kCorners>
std::array<CellNode, kCorners> sorted(std::array<CellNode, kCorners> t) {
  std::sort(t.begin(), t.end());
  return t;
}

constexpr std::array<CellFace, 6> kFaces{
    {{0, false}, {0, true}, {1, false}, {1, true}, {2, false}, {2, true}}};

TEST(Sec51CellTemplate, TetsFillTheCellAndEndAtItsSurfaceTriangles) {
  std::mt19937 random(521);
  for (int i = 0; i < 3000 && !HasFailure(); ++i) {
    const CellNodes nodes = i == 0 ? kCellCorners : random_nodes(random);
    SCOPED_TRACE(nodes);
    const CellTemplate cell = cut_cell(nodes, i % 2 == 0, Metric());
    std::int64_t sum = 0;
    std::map<NodeTriangle, int> sides;
    CellNodes used = 0;
    for (const NodeTet& t : cell.tets) {
      EXPECT_GT(size6(t), 0);
      sum += size6(t);
      for (std::size_t skip = 0; skip < 4; ++skip) {
        used |= 1U << t[skip];
        ++sides[sorted<3>({t[(skip + 1) % 4], t[(skip + 2) % 4], t[(skip + 3) % 4]})];
      }
    }
    EXPECT_EQ(sum, 6 * 8);
    EXPECT_EQ(used & ~(1U << kCellCentre), nodes) << "a node without a tet";
    std::set<NodeTriangle> outer, surface;
    for (const auto& [t, count] : sides) {
      EXPECT_LE(count, 2);
      if (count == 1) outer.insert(t);
    }
    for (const NodeTriangle& t : cell.surface) surface.insert(sorted<3>(t));
    EXPECT_EQ(surface.size(), cell.surface.size());
    EXPECT_EQ(outer, surface);
  }
}

TEST(Sec51CellTemplate, BothSidesOfAFaceFindTheSameTriangles) {
  std::mt19937 random(522);
  for (int i = 0; i < 2000; ++i) {
    const CellNodes here = random_nodes(random);
    const CellFace face = kFaces[random() % 6], back{face.axis, !face.high};
    const auto across = [&](CellNode n) {
      const unsigned step = 2 * (face.axis == 0 ? 1 : face.axis == 1 ? 3 : 9);
      return face.high ? n - step : n + step;
    };
    CellNodes beyond = random_nodes(random);
    for (CellNode n = 0; n < 27; ++n) {
      if (!is_on(n, face)) continue;
      beyond &= ~(1U << across(n));
      if (has_node(here, n)) beyond |= 1U << across(n);
    }
    const bool odd = random() % 2 == 0;
    std::set<NodeTriangle> ours, theirs;
    for (NodeTriangle t : face_triangles(here, odd, face)) {
      for (CellNode& n : t) n = across(n);
      ours.insert(sorted<3>(t));
    }
    for (const NodeTriangle& t : face_triangles(beyond, !odd, back)) theirs.insert(sorted<3>(t));
    EXPECT_EQ(ours, theirs);
  }
}

TEST(Sec51CellTemplate, ApexIsOnTheSurfaceWhereShapesAllowIt) {
  std::mt19937 random(523);
  int centres = 0;
  for (int i = 0; i < 1000; ++i) {
    const CellNodes nodes = random_nodes(random);
    if (nodes == kCellCorners) continue;
    const CellTemplate cell = cut_cell(nodes, false, Metric());
    const bool centre = cell.tets[0][0] == kCellCentre;
    centres += centre ? 1 : 0;
    double worst = 1.0;
    for (const NodeTet& t : cell.tets) {
      const Metric metric;
      const auto edge = [&](std::size_t k) {
        return metric.vector(point_of(t[0]), point_of(t[k]));
      };
      worst = std::min(worst, std::max(radius_ratio({edge(1), edge(2), edge(3)}),
                                       radius_ratio({edge(2), edge(1), edge(3)})));
    }
    EXPECT_GE(worst, 0.25) << nodes << ", the default quality floor could not be promised";
  }
  EXPECT_LT(centres, 300);
  EXPECT_GT(centres, 0);
}

TEST(Sec51CellTemplate, IsMadeOnceForEachPatternAndParity) {
  CellTemplates templates{Metric()};
  const CellNodes split = kCellCorners | 1U << 1;
  const CellTemplate& even = templates.of(split, false);
  const CellTemplate& odd = templates.of(split, true);
  EXPECT_NE(even.tets, odd.tets);
  EXPECT_EQ(&templates.of(split, false), &even);
  EXPECT_EQ(odd.tets, cut_cell(split, true, Metric()).tets);
}

TEST(Sec51CellTemplate, RoomIsMadeWhereTemplatesAreMany) {
  CellTemplates templates{Metric()};
  CellNodes nodes = kCellCorners;
  while (templates.size() <= CellTemplates::kMost) {
    const std::size_t before = templates.size();
    templates.make_room();
    ASSERT_EQ(templates.size(), before);
    (void)templates.of(nodes++ | kCellCorners, false);
  }
  templates.make_room();
  EXPECT_EQ(templates.size(), 0U);
}

constexpr int kLargest = 4;
constexpr double kRounding = 1e-12;

Metric random_metric(std::mt19937& random) {
  const auto length = [&] { return 1.0 + 0.01 * below(random, 300); };
  return Metric({length(), length(), length()});
}

TEST(Promise3Quality, StartKeepsEveryFloorOfIsotropicVoxels) {
  EXPECT_NEAR(min_start_ratio(Metric(), 0), std::sqrt(3.0) - 1, 1e-12);
  for (int level = 1; level <= kLargest; ++level) {
    EXPECT_GE(min_start_ratio(Metric(), level), 0.5) << "the highest floor that may be asked";
  }
}

TEST(Promise3Quality, NoCellIsWorseThanTheFloorOfTheStart) {
  std::mt19937 random(721);
  for (int i = 0; i < 3000 && !HasFailure(); ++i) {
    const Metric metric = i % 3 == 0 ? Metric() : random_metric(random);
    const double floor = min_start_ratio(metric, 1);
    const double asked = floor * (0.25 + 0.25 * below(random, 4));
    const CellNodes nodes = random_nodes(random);
    const CellTemplate cell = cut_cell(nodes, i % 2 == 0, metric, asked);
    EXPECT_GE(worst_ratio(cell.tets, metric), asked - kRounding) << nodes;
    for (const NodeTriangle& t : cell.surface) {
      const std::vector<NodeTet> mixed{{kCellCentre, t[0], t[1], t[2]}};
      EXPECT_GE(worst_ratio(mixed, metric), floor - kRounding) << nodes;
    }
  }
}

TEST(Promise3Quality, StartMeshesKeepTheFloorAtAnySpacing) {
  std::mt19937 random(722);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Metric metric = i % 4 == 0 ? Metric() : random_metric(random);
    const int level = static_cast<int>(below(random, 4));
    const double floor = min_start_ratio(metric, level);
    const Index3 shape{6 + below(random, 12), 6 + below(random, 12), 6 + below(random, 12)};
    const SmallVolume volume =
        random_volume_of(random, VolumeKind::kBlobs, shape, 1 + below(random, 4));
    BlockMesh block = start_block(volume, level_map(volume), {{0, 0, 0}, shape},
                                  {.max_level = level, .metric = metric, .quality_floor = floor});
    const TetMesh mesh(block.vertices, block.tets, far_corner(shape));
    for (const LocalTet& t : mesh.tets()) {
      EXPECT_GE(radius_ratio(mesh, metric, t), floor - kRounding);
    }
  }
}

/// Layers leave spacings at which the start keeps the default floor with something to spare.
TEST(Promise3Quality, StartKeepsTheDefaultFloorOnceSlicesAreCut) {
  double min = 1.0;
  for (double y = 1.0; y < 20.5; y += y < 4 ? 0.05 : 0.3) {
    for (double z = y; z < 20.5; z += z < 4 ? 0.05 : 0.3) {
      const std::array<double, 3> spacing{1, y, z};
      const Metric metric(layered_spacing(spacing, layers_of(spacing)));
      min = std::min(min, min_start_ratio(metric, kLargest));
    }
  }
  EXPECT_GE(min, 0.3);
}

// Leaves of the octree: by their definition, from labels alone, and from the
// map of large cells.

constexpr int kLevels = 4;

/// The rule word by word, over the whole volume.
class Definition {
 public:
  explicit Definition(const SmallVolume& volume)
      : all_{{0, 0, 0}, volume.shape}, labels_(labels_in(volume, all_)) {}

  [[nodiscard]] int level_at(Index3 voxel, int max_level) {
    for (int k = max_level; k > 0; --k) {
      if (is_allowed({voxel.x >> k, voxel.y >> k, voxel.z >> k}, k)) return k;
    }
    return 0;
  }

 private:
  bool is_allowed(Index3 cell, int k) {
    if (k == 0) return true;
    const auto key = std::tuple(k, cell.x, cell.y, cell.z);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    return known_[key] = is_uniform(cell, k) && finer_are_allowed(cell, k);
  }

  [[nodiscard]] bool is_uniform(Index3 cell, int k) const {
    const std::int64_t size = std::int64_t{1} << k;
    const Index3 lo{cell.x * size, cell.y * size, cell.z * size};
    bool uniform = true;
    for_each_index(Box3{lo, lo + Index3{size, size, size}}, [&](Index3 v) {
      uniform = uniform && all_.contains(v) && labels_.at(v) == labels_.at(lo);
    });
    return uniform;
  }

  /// In the cell or next to it; cells wholly outside the volume do not count.
  bool finer_are_allowed(Index3 cell, int k) {
    const std::int64_t size = std::int64_t{1} << (k - 1);
    bool allowed = true;
    for_each_index(Box3{{-1, -1, -1}, {3, 3, 3}}, [&](Index3 i) {
      const Index3 finer = Index3{2 * cell.x, 2 * cell.y, 2 * cell.z} + i;
      const Index3 lo{finer.x * size, finer.y * size, finer.z * size};
      const bool outside = lo.x < 0 || lo.y < 0 || lo.z < 0 || lo.x >= all_.hi.x ||
                           lo.y >= all_.hi.y || lo.z >= all_.hi.z;
      allowed = allowed && (outside || is_allowed(finer, k - 1));
    });
    return allowed;
  }

  Box3 all_;
  LabelBox labels_;
  std::map<std::tuple<int, std::int64_t, std::int64_t, std::int64_t>, bool> known_;
};

/// Calls visit(asked) for boxes that reach outside the volume, or do not.
template <typename Visit>
void each_random_box(std::mt19937& random, Index3 shape, Visit visit) {
  for (int i = 0; i < 3; ++i) {
    const auto part = [&](std::int64_t edge) {
      const std::int64_t lo = std::int64_t{below(random, static_cast<std::uint32_t>(edge))} - 1;
      return std::pair(lo, lo + 2 + below(random, 24));
    };
    const auto x = part(shape.x), y = part(shape.y), z = part(shape.z);
    visit(Box3{{x.first, y.first, z.first}, {x.second, y.second, z.second}});
  }
}

LabelBox labels_around(const SmallVolume& volume, const Box3& box, std::int64_t halo) {
  const Index3 around{halo, halo, halo};
  return labels_in(volume, {box.lo - around, box.hi + around});
}

TEST(CellLevels, FollowTheirDefinitionWithAndWithoutTheMap) {
  std::mt19937 random(1031);
  std::array<int, kLevels + 1> seen{};
  for (int i = 0; i < 24 && !HasFailure(); ++i) {
    const SmallVolume volume = random_with_large_cells(random);
    const LevelMap map = level_map(volume);
    Definition definition(volume);
    each_random_box(random, volume.shape, [&](const Box3& asked) {
      for (int level = 1; level <= kLevels; ++level) {
        const LabelBox wide = labels_around(volume, asked, (2 << level) - 2);
        const LabelBox narrow = labels_around(volume, asked, LevelMap::kHalo);
        const CellLevels alone(wide, volume.shape, asked, level);
        const CellLevels mapped(narrow, volume.shape, asked, level, map);
        for_each_index(asked, [&](Index3 v) {
          if (!Box3{{0, 0, 0}, volume.shape}.contains(v)) return;
          const int expected = definition.level_at(v, level);
          ASSERT_EQ(alone.level_at(v), expected);
          ASSERT_EQ(mapped.level_at(v), expected);
          ++seen[static_cast<std::size_t>(expected)];
        });
      }
    });
  }
  for (int count : seen) EXPECT_GT(count, 2000);
}

TEST(LevelMap, AllowsTheLargeCellsOfTheDefinition) {
  std::mt19937 random(1032);
  std::array<int, 2> allowed{};
  for (int i = 0; i < 20 && !HasFailure(); ++i) {
    const SmallVolume volume = random_with_large_cells(random);
    const LevelMap map = level_map(volume);
    Definition definition(volume);
    for_each_index(Box3{{-8, -8, -8}, volume.shape + Index3{8, 8, 8}}, [&](Index3 v) {
      if (((v.x | v.y | v.z) & 7) != 0) return;
      const bool inside = Box3{{0, 0, 0}, volume.shape}.contains(v);
      for (int level : {3, 4}) {
        const bool expected = inside && definition.level_at(v, level) == level;
        ASSERT_EQ(map.is_allowed(v, level), expected);
        allowed[static_cast<std::size_t>(level - 3)] += expected ? 1 : 0;
      }
    });
  }
  EXPECT_GT(allowed[0], 100);
  EXPECT_GT(allowed[1], 50);
}

}  // namespace
}  // namespace mw::test
