// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Thin labels and specks, against sets of voxels that are looked at one by one.
#include "kernels/surface/thin_label.h"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "kernels/core/index.h"
#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::test {
namespace {

using audit::test::below;

constexpr std::int64_t kEdge = 14;

LabelBox empty_box() {
  const Box3 box{{-3, 2, 0}, {kEdge - 3, kEdge + 2, kEdge}};
  return {box, std::vector<Label>(static_cast<std::size_t>(box.voxels()))};
}

Label& at(LabelBox& labels, Index3 voxel) {
  return labels.labels[static_cast<std::size_t>(labels.box.offset(voxel))];
}

Point corner(Index3 voxel) {
  const auto units = [](std::int64_t v) { return static_cast<std::int32_t>(v * kUnitsPerVoxel); };
  return {units(voxel.x), units(voxel.y), units(voxel.z)};
}

Index3 in_the_middle(std::mt19937& random, const Box3& box) {
  const auto step = [&] { return std::int64_t{4} + below(random, 6); };
  const std::int64_t x = step(), y = step();
  return box.lo + Index3{x, y, step()};
}

/// Puts boxes of random sizes into the label 1.
LabelBox random_boxes(std::mt19937& random) {
  LabelBox out = empty_box();
  for (std::uint32_t i = 0; i < 1 + below(random, 4); ++i) {
    const Index3 lo = in_the_middle(random, out.box);
    const Index3 size{1 + below(random, 3), 1 + below(random, 3), 1 + below(random, 2)};
    for_each_index(Box3{lo, lo + size}, [&](Index3 v) { at(out, v) = 1; });
  }
  return out;
}

/// The voxels of the label whose centres are within a cube around a corner.
std::vector<Index3> voxels_near(const LabelBox& labels, Index3 around, double reach) {
  std::vector<Index3> out;
  for_each_index(labels.box, [&](Index3 v) {
    const auto distance = [](std::int64_t a, std::int64_t b) {
      return std::abs(static_cast<double>(a) + 0.5 - static_cast<double>(b));
    };
    const double most =
        std::max({distance(v.x, around.x), distance(v.y, around.y), distance(v.z, around.z)});
    if (labels.at(v) == 1 && most < reach) out.push_back(v);
  });
  return out;
}

/// Whether eight of the voxels make a cube: each voxel is tried as its lowest.
bool has_cube(const std::vector<Index3>& voxels) {
  return std::any_of(voxels.begin(), voxels.end(), [&](Index3 lo) {
    const auto in_cube = std::count_if(voxels.begin(), voxels.end(), [&](Index3 v) {
      const Index3 d = v - lo;
      return d.x >= 0 && d.x < 2 && d.y >= 0 && d.y < 2 && d.z >= 0 && d.z < 2;
    });
    return in_cube == 8;
  });
}

/// Compares what is found at a corner with its voxels, and counts it.
struct ThinCheck {
  void look_at(const LabelBox& labels, Index3 around) {
    const bool expected = !has_cube(voxels_near(labels, around, 2));
    const bool ends =
        voxels_near(labels, around, 3).size() == voxels_near(labels, around, 4).size();
    const auto found = thin_label_at(labels, corner(around), 1);
    EXPECT_EQ(found.has_value(), expected);
    EXPECT_EQ(found && found->is_speck, expected && ends);
    thin += expected ? 1 : 0;
    specks += expected && ends ? 1 : 0;
  }

  int thin = 0, specks = 0;
};

TEST(ThinLabel, HasNoCubeOfEightVoxelsWithinTwo) {
  std::mt19937 random(60);
  ThinCheck check;
  for (int i = 0; i < 2000 && !HasFailure(); ++i) {
    const LabelBox labels = random_boxes(random);
    const Index3 around = in_the_middle(random, labels.box);
    check.look_at(labels, around);
  }
  EXPECT_GT(check.specks, 100);
  EXPECT_GT(check.thin, check.specks + 100);
  EXPECT_LT(check.thin, 1950);
}

/// Boxes end anywhere, and corners lie anywhere around them: what is beyond has other labels.
TEST(ThinLabel, LooksAtWhatABoxHasAlone) {
  std::mt19937 random(64);
  ThinCheck check;
  for (int i = 0; i < 4000 && !HasFailure(); ++i) {
    LabelBox labels{{{8, 6, 7}, {}}, {}};
    const auto edge = [&] { return std::int64_t{1} + below(random, kEdge); };
    const std::int64_t x = edge(), y = edge();
    labels.box.hi = labels.box.lo + Index3{x, y, edge()};
    labels.labels.assign(static_cast<std::size_t>(labels.box.voxels()), 0);
    const std::uint32_t others = below(random, 6);
    for (Label& label : labels.labels) label = below(random, others + 1) == 0 ? 1 : 0;
    const Box3 wide = grown(labels.box, 5);
    const auto place = [&](std::int64_t lo, std::int64_t hi) {
      return lo + below(random, static_cast<std::uint32_t>(hi - lo));
    };
    const std::int64_t at_x = place(wide.lo.x, wide.hi.x), at_y = place(wide.lo.y, wide.hi.y);
    const Index3 around{at_x, at_y, place(wide.lo.z, wide.hi.z)};
    check.look_at(labels, around);
  }
  EXPECT_LT(check.thin, 3950);
  EXPECT_GT(check.specks, 100);
  EXPECT_LT(check.specks, check.thin - 100);
}

/// Puts a sheet across an axis, with holes, or a thread along it, that may both be bent and end
/// somewhere, into the label 1.
LabelBox random_sheet_or_thread(std::mt19937& random, bool is_thread) {
  LabelBox out = empty_box();
  const std::int64_t axis = below(random, 3), bends = below(random, 4), wide = 1 + below(random, 2);
  const std::int64_t end = 8 + below(random, 8);
  const auto along = [&](Index3 v, std::int64_t k) {
    const std::array<std::int64_t, 3> from{v.x - out.box.lo.x, v.y - out.box.lo.y,
                                           v.z - out.box.lo.z};
    return from[static_cast<std::size_t>((axis + k) % 3)];
  };
  for_each_index(out.box, [&](Index3 v) {
    const std::int64_t height = along(v, 0), a = along(v, 1), b = along(v, 2);
    const std::int64_t rise = bends == 0 ? 0 : a / (2 * bends);
    const bool is_near = height - 6 - rise >= 0 && height - 6 - rise < (a < 7 ? 1 : wide);
    if (is_near && a < end && (is_thread ? b == 6 : below(random, 12) > 0)) at(out, v) = 1;
  });
  return out;
}

/// The axes across which voxels are in `count` layers.
std::vector<std::size_t> layers_of(const std::vector<Index3>& voxels, std::size_t count) {
  std::array<std::set<std::int64_t>, 3> layers;
  for (const Index3 v : voxels) {
    layers[0].insert(v.x);
    layers[1].insert(v.y);
    layers[2].insert(v.z);
  }
  std::vector<std::size_t> out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (layers[axis].size() == count) out.push_back(axis);
  }
  return out;
}

/// The pairs of voxels that have an edge in common and neither of the other two voxels there.
std::size_t touches_of(const std::vector<Index3>& voxels) {
  std::set<std::array<std::int64_t, 3>> all;
  for (const Index3 v : voxels) all.insert({v.x, v.y, v.z});
  std::size_t touches = 0;
  for (const auto& a : all) {
    for (const auto& b : all) {
      if (!(a < b)) continue;
      std::size_t same = 0, between = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (std::abs(a[axis] - b[axis]) > 1) same = 3;
        if (a[axis] == b[axis]) {
          ++same;
          continue;
        }
        std::array<std::int64_t, 3> other = a;
        other[axis] = b[axis];
        between += all.count(other);
      }
      touches += same == 1 && between == 0 ? 1 : 0;
    }
  }
  return touches;
}

TEST(ThinLabel, IsASheetOrAThreadWhereItGoesOn) {
  std::mt19937 random(61);
  std::array<int, 4> found{};  // none, thread, sheet, held sheet
  int small = 0;
  for (int i = 0; i < 3000; ++i) {
    const LabelBox labels =
        i % 3 == 0 ? random_boxes(random) : random_sheet_or_thread(random, i % 3 == 1);
    const Index3 around = in_the_middle(random, labels.box);
    const std::vector<Index3> near = voxels_near(labels, around, 4);
    const bool is_sheet = near.size() >= 56 && layers_of(near, 1).empty() &&
                          !has_cube(voxels_near(labels, around, 5));
    const bool is_thread = near.size() <= 20 && !layers_of(near, 8).empty() &&
                           !has_cube(voxels_near(labels, around, 2));
    const auto thin = thin_label_at(labels, corner(around), 1);
    EXPECT_EQ(thin && thin->is_sheet, is_sheet) << i;
    EXPECT_EQ(thin && thin->is_thread, is_thread) << i;
    const bool is_held = is_sheet && touches_of(near) >= 16;
    EXPECT_EQ(thin && thin->is_held, is_held) << i;
    const bool is_small = near.size() <= 3 && layers_of(near, 8).empty();
    EXPECT_TRUE(!thin || thin->is_small == is_small) << i;
    small += thin && is_small ? 1 : 0;
    ++found[is_held ? 3 : is_sheet ? 2 : is_thread ? 1 : 0];
  }
  for (const int count : found) EXPECT_GT(count, 50);
  EXPECT_GT(small, 50);
}

/// The voxels of a part, from one voxel on.
std::vector<Index3> part_from(const std::vector<Index3>& voxels, Index3 first) {
  std::vector<Index3> out{first};
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (const Index3 v : voxels) {
      const Index3 d = v - out[i];
      const bool touches = std::abs(d.x) + std::abs(d.y) + std::abs(d.z) == 1;
      if (touches && std::find(out.begin(), out.end(), v) == out.end()) out.push_back(v);
    }
  }
  return out;
}

TEST(VoxelsOfPart, AreThoseThatHangTogetherByFaces) {
  std::mt19937 random(62);
  int whole = 0, cut = 0, single = 0;
  for (int i = 0; i < 1500; ++i) {
    const LabelBox labels = random_boxes(random);
    const Index3 around = in_the_middle(random, labels.box);
    Point place = corner(around);
    place.x += 20;
    place.y += 41;
    place.z += 83;
    const std::vector<Index3> near = voxels_near(labels, around, 4);
    const auto squared = [&](Index3 v) {
      const Index3 middle = Index3{2 * v.x + 1, 2 * v.y + 1, 2 * v.z + 1};
      const Index3 d{middle.x * kUnitsPerVoxel / 2 - place.x,
                     middle.y * kUnitsPerVoxel / 2 - place.y,
                     middle.z * kUnitsPerVoxel / 2 - place.z};
      return d.x * d.x + d.y * d.y + d.z * d.z;
    };
    std::size_t expected = 0;
    if (!near.empty()) {
      const std::vector<Index3> part =
          part_from(near, *std::ranges::min_element(near, {}, squared));
      const std::vector<Index3> inner = voxels_near(labels, around, 3);
      const bool is_inside = std::ranges::all_of(
          part, [&](Index3 v) { return std::find(inner.begin(), inner.end(), v) != inner.end(); });
      expected = is_inside ? part.size() : 0;
      (is_inside ? whole : cut) += 1;
      single += part.size() < near.size() ? 1 : 0;
    }
    EXPECT_EQ(voxels_of_part(labels, place, 1), expected) << i;
  }
  EXPECT_GT(whole, 200);
  EXPECT_GT(cut, 200);
  EXPECT_GT(single, 100);
}

/// The corner nearest to a place decides.
TEST(ThinLabel, IsThatOfTheNearestCorner) {
  LabelBox labels = empty_box();
  for_each_index(Box3{{0, 8, 4}, {2, 10, 6}}, [&](Index3 v) { at(labels, v) = 1; });
  Point place = corner({3, 9, 5});
  place.x += kUnitsPerVoxel / 2 - 1;
  EXPECT_TRUE(thin_label_at(labels, place, 1));
  place.x -= kUnitsPerVoxel;
  EXPECT_FALSE(thin_label_at(labels, place, 1));
}

}  // namespace
}  // namespace mw::test
