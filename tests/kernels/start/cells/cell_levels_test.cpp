// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Leaves of the octree: by their definition, from labels alone, and from the
// map of large cells.
#include "kernels/start/cells/cell_levels.h"

#include <gtest/gtest.h>

#include "tests/kernels/start/cells/large_cells.h"

namespace mw::test {
namespace {

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
