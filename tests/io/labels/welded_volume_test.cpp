// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Welded volumes against the rule, read literally from a whole array.
#include "io/labels/welded_volume.h"

#include "tests/io/labels/memory_volume.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

using audit::test::below;
using audit::test::random_volume_of;
using audit::test::SmallVolume;
using audit::test::VolumeKind;

constexpr std::uint64_t kEnough = 1 << 20;

/// One round of the rule on a whole array.
class Round {
 public:
  Round(Index3 shape, const std::vector<RawLabel>& labels, const std::set<RawLabel>& givers)
      : all_{{0, 0, 0}, shape}, labels_(labels), givers_(givers) {}

  [[nodiscard]] bool solid(Index3 v) const { return all_.contains(v) && givers_.count(at(v)) == 0; }

  /// By voxel, in every place of the volume.
  [[nodiscard]] std::map<std::int64_t, RawLabel> filled() const {
    std::map<std::int64_t, RawLabel> out;
    const auto fill = [&](Index3 v) { out[all_.offset(v)] = label_for(v); };
    for_each_index(all_, [&](Index3 v) {
      for_each_index(all_, [&](Index3 w) {
        if (!solid(v) || !solid(w) || !(all_.offset(v) < all_.offset(w))) return;
        const Index3 d{std::abs(w.x - v.x), std::abs(w.y - v.y), std::abs(w.z - v.z)};
        if (std::max({d.x, d.y, d.z}) != 1) return;
        std::vector<Index3> others;
        for_each_index(Box3{{0, 0, 0}, {2, 2, 2}}, [&](Index3 t) {
          const Index3 u{t.x != 0 ? w.x : v.x, t.y != 0 ? w.y : v.y, t.z != 0 ? w.z : v.z};
          if (u != v && u != w && std::find(others.begin(), others.end(), u) == others.end()) {
            others.push_back(u);
          }
        });
        const bool alone =
            std::none_of(others.begin(), others.end(), [&](Index3 u) { return solid(u); });
        if (!alone || d.x + d.y + d.z < 2) return;
        if (d.x + d.y + d.z == 3) {
          fill({v.x, v.y, w.z});
          fill({v.x, w.y, w.z});
          return;
        }
        std::sort(others.begin(), others.end(), [&](Index3 a, Index3 b) {
          const std::size_t of_a = neighbours(a).size(), of_b = neighbours(b).size();
          return of_a != of_b ? of_a > of_b : all_.offset(a) < all_.offset(b);
        });
        fill(others.front());
      });
    });
    return out;
  }

 private:
  [[nodiscard]] RawLabel at(Index3 v) const {
    return labels_[static_cast<std::size_t>(all_.offset(v))];
  }
  [[nodiscard]] std::vector<RawLabel> neighbours(Index3 v) const {
    std::vector<RawLabel> out;
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int64_t by : {-1, 1}) {
        const Index3 w = v + Index3{axis == 0 ? by : 0, axis == 1 ? by : 0, axis == 2 ? by : 0};
        if (solid(w)) out.push_back(at(w));
      }
    }
    return out;
  }
  [[nodiscard]] RawLabel label_for(Index3 v) const {
    std::map<RawLabel, int> counts;
    for (const RawLabel label : neighbours(v)) ++counts[label];
    RawLabel best = 0;
    int most = 0;
    for (const auto& [label, count] : counts) {
      if (count > most) best = label;
      most = std::max(most, count);
    }
    return best;
  }

  Box3 all_;
  const std::vector<RawLabel>& labels_;
  const std::set<RawLabel>& givers_;
};

TEST(WeldedVolume, FillsWhatTheRuleSays) {
  std::mt19937 random(611);
  int welded = 0, rounds = 0;
  for (std::uint32_t i = 0; i < 400 && !HasFailure(); ++i) {
    const Index3 shape = audit::test::random_shape(random, 1, 6);
    const SmallVolume small = random_volume_of(
        random, static_cast<VolumeKind>(i % audit::test::kVolumeKinds), shape, 2 + i % 3);
    const MemoryVolume volume = volume_of(small, VoxelType::kU32, {5, 2, 9, 11});
    std::vector<RawLabel> labels = read_all(volume);
    const std::set<RawLabel> present(labels.begin(), labels.end());
    std::set<RawLabel> givers{*present.begin()};
    if (present.size() > 2 && i % 2 == 0) givers.insert(*std::next(present.begin()));
    const WeldedVolume welds(volume, {givers.begin(), givers.end()}, kEnough);
    WeldFacts facts;
    for (;;) {
      const auto filled = Round(shape, labels, givers).filled();
      if (filled.empty()) break;
      ++facts.rounds;
      facts.voxels += filled.size();
      for (const auto& [at, label] : filled) labels[static_cast<std::size_t>(at)] = label;
    }
    EXPECT_EQ(read_all(welds), labels) << small.text();
    EXPECT_EQ(welds.facts().voxels, facts.voxels);
    EXPECT_EQ(welds.facts().rounds, facts.rounds);
    EXPECT_EQ(welds.facts().has_solid, givers.size() < present.size());
    welded += facts.voxels > 0 ? 1 : 0;
    rounds += facts.rounds > 1 ? 1 : 0;
  }
  EXPECT_GT(welded, 40);
  EXPECT_GT(rounds, 10);
}

/// Tiles do not show: a chain of voxels that touch at corners goes through several of them.
TEST(WeldedVolume, FillsAcrossTiles) {
  constexpr std::int64_t kLong = 300;
  SmallVolume small{{kLong, 3, 3}, 3, std::vector<Label>(kLong * 9, 0)};
  for (std::int64_t x = 0; x < kLong; ++x) {
    const std::int64_t at = x % 2;
    small.labels[static_cast<std::size_t>((at * 3 + at) * kLong + x)] = x < kLong / 2 ? 1 : 2;
  }
  const MemoryVolume volume = volume_of(small, VoxelType::kU32, {0, 1, 2});
  const WeldedVolume welds(volume, {0}, kEnough);
  EXPECT_EQ(welds.facts().voxels, 1U * kLong);  // two at every second voxel of the chain
  EXPECT_EQ(welds.facts().rounds, 1);
  const std::vector<RawLabel> all = read_all(welds);
  for (std::int64_t x = 100; x < 160; ++x) {
    std::vector<RawLabel> part(9);
    welds.read({{x, 0, 0}, {x + 1, 3, 3}}, part);
    for (std::size_t i = 0; i < part.size(); ++i) {
      EXPECT_EQ(part[i], all[i * kLong + static_cast<std::size_t>(x)]);
    }
  }
}

TEST(WeldedVolume, RefusesWhatItCannotDo) {
  std::mt19937 random(612);
  const SmallVolume small = random_volume_of(random, VolumeKind::kNoise, {20, 20, 20}, 2);
  const MemoryVolume volume = volume_of(small, VoxelType::kU32, {0, 1});
  expect_error(ErrorKind::kUsage, {"--weld: the volume has no label 77"}, [&] {
    WeldedVolume(volume, {0, 77}, kEnough);
  });
  expect_error(ErrorKind::kResource, {"--weld", "--memory"},
               [&] { WeldedVolume(volume, {0}, 1000); });
}

/// A volume that tells how far it was read.
class WatchedVolume : public VolumeView {
 public:
  using VolumeView::VolumeView;
  void read(const Box3& box, std::span<RawLabel> out) const override {
    ++reads_;
    below().read(box, out);
  }
  [[nodiscard]] int reads() const { return reads_; }

 private:
  mutable int reads_ = 0;
};

TEST(WeldedVolume, StopsAtTheFirstTileThatTakesTooMuch) {
  std::mt19937 random(613);
  const SmallVolume small = random_volume_of(random, VolumeKind::kNoise, {400, 4, 4}, 2);
  const MemoryVolume volume = volume_of(small, VoxelType::kU32, {0, 1});
  const WatchedVolume watched(volume);
  expect_error(ErrorKind::kResource, {"--weld", "more than 1000 bytes"},
               [&] { WeldedVolume(watched, {0}, 1000); });
  EXPECT_EQ(watched.reads(), 1);
}

/// Many edges ask for one voxel, which counts once.
TEST(WeldedVolume, NeedsNoMoreThanWhatItHolds) {
  std::mt19937 random(614);
  const SmallVolume small = random_volume_of(random, VolumeKind::kNoise, {20, 20, 20}, 2);
  const MemoryVolume volume = volume_of(small, VoxelType::kU32, {0, 1});
  const WeldedVolume free(volume, {0}, kEnough);
  const std::uint64_t bytes = free.facts().voxels * 16;
  EXPECT_EQ(read_all(WeldedVolume(volume, {0}, bytes)), read_all(free));
  expect_error(ErrorKind::kResource, {"--weld"}, [&] { WeldedVolume(volume, {0}, bytes - 1); });
}

}  // namespace
}  // namespace mw::io
