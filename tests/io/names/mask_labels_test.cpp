// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Masks after their labels were chosen or merged, against sets of voxels.
#include "io/names/mask_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace mw::io {
namespace {

/// One voxel of each label, and the masks that it is in.
using Voxels = std::vector<std::set<std::size_t>>;

std::vector<MaskLabels> masks_of(const Voxels& voxels, std::size_t count) {
  std::vector<MaskLabels> out;
  for (std::size_t mask = 0; mask < count; ++mask) {
    MaskLabels labels{.name = std::to_string(mask), .labels = {}};
    for (RawLabel label = 1; label < voxels.size(); ++label) {
      if (voxels[label].contains(mask)) labels.labels.push_back(label);
    }
    if (!labels.labels.empty()) out.push_back(std::move(labels));
  }
  return out;
}

TEST(MaskLabels, OfMergedLabelsAreTheSameVoxelsOrLeftOut) {
  std::mt19937 random(37);
  std::size_t kept = 0, left_out = 0;
  for (int round = 0; round < 500; ++round) {
    const std::size_t count = 1 + random() % 4;
    Voxels voxels(2 + random() % 6);
    for (std::size_t label = 1; label < voxels.size(); ++label) {
      voxels[label].insert(random() % count);
      voxels[label].insert(random() % count);
    }
    std::map<RawLabel, RawLabel> becomes;
    for (std::size_t label = 0; label < voxels.size(); ++label) {
      if (random() % 4 == 0) becomes[label] = random() % (voxels.size() + 2);
    }
    const auto label_of = [&](RawLabel voxel) {
      return becomes.contains(voxel) ? becomes.at(voxel) : voxel;
    };
    const std::vector<MaskLabels> before = masks_of(voxels, count);
    const std::vector<MaskLabels> after = merged_masks(before, becomes);
    for (const MaskLabels& mask : before) {
      const std::size_t number = std::stoul(mask.name);
      std::set<RawLabel> inside, outside;
      for (RawLabel voxel = 0; voxel < voxels.size(); ++voxel) {
        (voxels[voxel].contains(number) ? inside : outside).insert(label_of(voxel));
      }
      const bool is_told_apart =
          std::ranges::none_of(inside, [&](RawLabel label) { return outside.contains(label); });
      const auto found =
          std::ranges::find(after, mask.name, [](const MaskLabels& each) { return each.name; });
      EXPECT_EQ(found != after.end(), is_told_apart);
      is_told_apart ? ++kept : ++left_out;
      if (found == after.end()) continue;
      EXPECT_EQ(found->labels, std::vector(inside.begin(), inside.end()));
    }
  }
  EXPECT_GT(kept, 100U);
  EXPECT_GT(left_out, 100U);
}

TEST(MaskLabels, WithoutLabelsThatAreNotWantedAreLeftOut) {
  const std::vector<MaskLabels> masks{{"a", {1, 3}}, {"b", {2, 3}}, {"c", {4}}};
  const auto small = [](RawLabel label) { return label < 3; };
  EXPECT_EQ(only_masks(masks, small), (std::vector<MaskLabels>{{"a", {1}}, {"b", {2}}}));
}

}  // namespace
}  // namespace mw::io
