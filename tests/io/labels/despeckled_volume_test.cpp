// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Specks against a literal reading of the rule: components by flooding, round by round.
#include "io/labels/specks.h"

#include "tests/io/labels/memory_volume.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

using audit::test::SmallVolume;

/// The rule on a whole array.
class Oracle {
 public:
  Oracle(const MemoryVolume& volume, SpeckRule rule)
      : all_{{0, 0, 0}, volume.info().shape},
        rule_(rule),
        signed_(has_signed_labels(volume.info())),
        labels_(volume.labels()) {}

  void run() {
    for (;;) {
      find_components();
      const std::map<int, RawLabel> changes = choices();
      if (changes.empty()) return;
      ++facts.rounds;
      facts.components += changes.size();
      for (std::size_t i = 0; i < labels_.size(); ++i) {
        const auto change = changes.find(component_[i]);
        if (change == changes.end()) continue;
        labels_[i] = change->second;
        ++facts.voxels;
      }
    }
  }

  [[nodiscard]] const std::vector<RawLabel>& labels() const { return labels_; }
  SpeckFacts facts;

 private:
  [[nodiscard]] std::size_t at(Index3 v) const { return static_cast<std::size_t>(all_.offset(v)); }

  void find_components() {
    component_.assign(labels_.size(), -1);
    voxels_.clear();
    for_each_index(all_, [&](Index3 v) {
      if (component_[at(v)] < 0) flood(v, static_cast<int>(voxels_.size()));
    });
  }

  void flood(Index3 first, int id) {
    std::vector<Index3> todo{first};
    component_[at(first)] = id;
    voxels_.push_back(0);
    while (!todo.empty()) {
      const Index3 v = todo.back();
      todo.pop_back();
      ++voxels_.back();
      for_each_index(Box3{v - Index3{1, 1, 1}, v + Index3{2, 2, 2}}, [&](Index3 w) {
        const auto steps = std::abs(w.x - v.x) + std::abs(w.y - v.y) + std::abs(w.z - v.z);
        if (!all_.contains(w) || steps > (rule_.diagonal ? 3 : 1)) return;
        if (component_[at(w)] >= 0 || labels_[at(w)] != labels_[at(v)]) return;
        component_[at(w)] = id;
        todo.push_back(w);
      });
    }
  }

  [[nodiscard]] bool is_speck(std::size_t i) const {
    return voxels_[static_cast<std::size_t>(component_[i])] < rule_.min;
  }

  /// By component: the label that it takes.
  [[nodiscard]] std::map<int, RawLabel> choices() const {
    std::map<int, std::map<RawLabel, int>> faces;
    for_each_index(all_, [&](Index3 v) {
      if (!is_speck(at(v))) return;
      for (const Index3 step : {Index3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
        for (const Index3 w : {v + step, v - step}) {
          if (all_.contains(w) && !is_speck(at(w))) ++faces[component_[at(v)]][labels_[at(w)]];
        }
      }
    });
    std::map<int, RawLabel> out;
    for (const auto& [speck, counts] : faces) out[speck] = best(counts);
    return out;
  }

  [[nodiscard]] RawLabel best(const std::map<RawLabel, int>& counts) const {
    const auto less = [&](RawLabel a, RawLabel b) {
      return signed_ ? static_cast<std::int64_t>(a) < static_cast<std::int64_t>(b) : a < b;
    };
    auto found = counts.begin();
    for (auto i = counts.begin(); i != counts.end(); ++i) {
      const bool ties = i->second == found->second;
      if (i->second > found->second || (ties && less(i->first, found->first))) found = i;
    }
    return found->first;
  }

  Box3 all_;
  SpeckRule rule_;
  bool signed_;
  std::vector<RawLabel> labels_;
  std::vector<int> component_;
  std::vector<std::uint64_t> voxels_;
};

void expect_as_oracle(const MemoryVolume& volume, SpeckRule rule, const SpeckLimits& limits) {
  Oracle oracle(volume, rule);
  oracle.run();
  const DespeckledVolume despeckled(volume, rule, limits);
  EXPECT_EQ(read_all(despeckled), oracle.labels());
  EXPECT_EQ(despeckled.facts().components, oracle.facts.components);
  EXPECT_EQ(despeckled.facts().voxels, oracle.facts.voxels);
  EXPECT_EQ(despeckled.facts().rounds, oracle.facts.rounds);
}

const std::vector<RawLabel> kRaw{7, ~RawLabel{0}, 0, RawLabel{1} << 40U, 3, 250};

class DespeckledVolumeTest : public testing::TestWithParam<bool> {};

TEST_P(DespeckledVolumeTest, IsWhatTheRuleSays) {
  std::mt19937 random(2024);
  int rounds = 0;
  std::uint64_t components = 0;
  for (int i = 0; i < 6000 && !HasFailure(); ++i) {
    const SmallVolume small = audit::test::random_volume(random);
    const VoxelType type = i % 2 == 0 ? VoxelType::kI64 : VoxelType::kU64;
    const MemoryVolume volume = volume_of(small, type, kRaw);
    const SpeckRule rule{1 + audit::test::below(random, i % 3 == 0 ? 30 : 6), GetParam()};
    SCOPED_TRACE(small.text() + " least " + std::to_string(rule.min));
    const SpeckLimits limits{.slab_voxels = 1 + audit::test::below(random, 60)};
    expect_as_oracle(volume, rule, limits);
    const DespeckledVolume despeckled(volume, rule, limits);
    expect_box(despeckled, read_all(despeckled), random);
    rounds = std::max(rounds, despeckled.facts().rounds);
    components += despeckled.facts().components;
  }
  EXPECT_GE(rounds, 3) << "rounds were hardly tested";
  EXPECT_GT(components, 1000);
}

/// Larger ones, where parts meet late and in several planes.
TEST_P(DespeckledVolumeTest, IsWhatTheRuleSaysOfLargerVolumes) {
  std::mt19937 random(77);
  for (std::uint32_t kind = 0; kind < 3 * audit::test::kVolumeKinds && !HasFailure(); ++kind) {
    const auto which = static_cast<audit::test::VolumeKind>(kind % audit::test::kVolumeKinds);
    const SmallVolume small = audit::test::random_volume_of(random, which, {17, 13, 11}, 5);
    const MemoryVolume volume = volume_of(small, VoxelType::kI64, kRaw);
    for (const std::uint64_t min : {2U, 5U, 40U, 700U}) {
      SCOPED_TRACE(std::to_string(kind) + " least " + std::to_string(min));
      expect_as_oracle(volume, {min, GetParam()}, {.slab_voxels = 300});
    }
  }
}

TEST_P(DespeckledVolumeTest, DoesNotDependOnSlabs) {
  std::mt19937 random(5);
  const SmallVolume small =
      audit::test::random_volume_of(random, audit::test::VolumeKind::kNoise, {9, 8, 7}, 3);
  const MemoryVolume volume = volume_of(small, VoxelType::kU8, {1, 2, 3});
  const SpeckRule rule{6, GetParam()};
  const std::vector<RawLabel> once = read_all(DespeckledVolume(volume, rule));
  for (std::int64_t slab = 1; slab < 9 * 8 * 7 + 2; ++slab) {
    EXPECT_EQ(read_all(DespeckledVolume(volume, rule, {.slab_voxels = slab})), once) << slab;
  }
}

INSTANTIATE_TEST_SUITE_P(Connectivity, DespeckledVolumeTest, testing::Bool(),
                         [](const auto& test) { return test.param ? "By26" : "By6"; });

TEST(DespeckledVolume, DoesWithTheRowOfTheReadmeWhatTheReadmeSays) {
  const MemoryVolume volume({8, 1, 1}, VoxelType::kU8, {1, 1, 1, 2, 1, 3, 4, 4});
  const DespeckledVolume despeckled(volume, {2, false});
  EXPECT_EQ(read_all(despeckled), (std::vector<RawLabel>{1, 1, 1, 1, 1, 4, 4, 4}));
  EXPECT_EQ(despeckled.facts().components, 2U);
  EXPECT_EQ(despeckled.facts().rounds, 1);
}

TEST(DespeckledVolume, LeavesNothingButSpecksAsItIs) {
  const MemoryVolume volume({2, 2, 1}, VoxelType::kU8, {1, 2, 3, 4});
  const DespeckledVolume despeckled(volume, {100, false});
  EXPECT_EQ(read_all(despeckled), volume.labels());
  EXPECT_EQ(despeckled.facts().components, 0U);
  EXPECT_EQ(despeckled.facts().rounds, 0);
}

/// 4,000 specks of one voxel in a block of zeros.
MemoryVolume dusty() {
  std::vector<RawLabel> labels(40 * 40 * 40);
  std::size_t specks = 0;
  for (std::size_t i = 0; i < labels.size() && specks < 4000; i += 2) {
    const bool even_row = i / 40 % 2 == 0, even_plane = i / 1600 % 2 == 0;
    if (even_row && even_plane) labels[i] = 1 + specks++;
  }
  EXPECT_EQ(specks, 4000U);
  return {{40, 40, 40}, VoxelType::kU32, std::move(labels)};
}

TEST(DespeckledVolume, RefusesMoreSpecksThanMemoryHolds) {
  const MemoryVolume volume = dusty();
  const DespeckledVolume budget_is_ample(volume, {2, false}, {.memory = 1 << 20});
  EXPECT_EQ(budget_is_ample.facts().components, 4000U);
  EXPECT_GE(budget_is_ample.held_bytes(), 4000U * sizeof(SpeckRun));
  EXPECT_LE(budget_is_ample.held_bytes(), 1U << 17U);
  // The runs alone, then their contacts, then two planes of the volume.
  for (const std::uint64_t memory : {150'000U, 200'000U}) {
    expect_error(ErrorKind::kResource,
                 {"--drop-specks 2", "4000 components", "--memory 2MiB is enough"}, [&] {
                   DespeckledVolume(volume, {2, false}, {.memory = memory, .is_of_budget = true});
                 });
  }
  expect_error(ErrorKind::kResource, {"--drop-specks", "slices", "takes --memory 1MiB"}, [&] {
    DespeckledVolume(volume, {2, false}, {.memory = 5000, .is_of_budget = true});
  });
}

TEST(DespeckledVolume, SaysWhatFitsInTheUnitOfTheMemoryThatHelps) {
  constexpr std::uint64_t kMebibyte = 1 << 20;
  const SpeckLimits limits{.memory = 3 * kMebibyte, .is_of_budget = true};
  expect_error(ErrorKind::kResource, {"fit into 3MiB; they take 4.5MiB; --memory 18MiB is enough"},
               [&] {
                 fail_too_many_specks({2, false}, 9, limits, 9 * kMebibyte / 2);
               });
}

/// The error of a search within so much memory; empty when there is none.
std::string error_of(const MemoryVolume& volume, const SpeckRule& rule, std::uint64_t memory) {
  try {
    const DespeckledVolume despeckled(volume, rule, {.memory = memory});
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    return error.what();
  }
}

/// The bytes that the error asks for.
std::uint64_t asked_in(const std::string& message) {
  const std::size_t at = message.find("they take ");
  return at == message.npos ? 0 : std::stoull(message.substr(at + 10));
}

/// The least that works, by trial.
std::uint64_t min_of(const MemoryVolume& volume, const SpeckRule& rule, std::uint64_t works) {
  std::uint64_t fails = 0;
  while (works - fails > 1) {
    const std::uint64_t memory = fails + (works - fails) / 2;
    (error_of(volume, rule, memory).empty() ? works : fails) = memory;
  }
  return works;
}

/// From next to nothing by the advice of errors; how many times the least it ends in.  Slices are
/// told of one by one, specks at once.
double advice_to_min(const MemoryVolume& volume, const SpeckRule& rule) {
  std::uint64_t memory = 1;
  bool is_last = false;
  for (;;) {
    const std::string error = error_of(volume, rule, memory);
    if (error.empty()) break;
    EXPECT_FALSE(is_last) << error;
    is_last = error.find("components are smaller") != error.npos;
    EXPECT_GT(asked_in(error), memory) << error;
    memory = std::max(asked_in(error), memory + 1);
  }
  return static_cast<double>(memory) / static_cast<double>(min_of(volume, rule, memory));
}

TEST(DespeckledVolume, WhatAnErrorAsksForWorks) {
  std::mt19937 random(31);
  double worst = 1;
  for (std::uint32_t i = 0; i < 2 * audit::test::kVolumeKinds && !HasFailure(); ++i) {
    const auto kind = static_cast<audit::test::VolumeKind>(i % audit::test::kVolumeKinds);
    const SmallVolume small = audit::test::random_volume_of(random, kind, {23, 17, 19}, 6);
    const MemoryVolume volume = volume_of(small, VoxelType::kI64, kRaw);
    for (const SpeckRule rule : {SpeckRule{2, false}, {9, false}, {3, true}, {1000, true}}) {
      SCOPED_TRACE(std::to_string(i) + " least " + std::to_string(rule.min));
      worst = std::max(worst, advice_to_min(volume, rule));
    }
  }
  EXPECT_LE(worst, 2.5) << "it is far from the least";
}

TEST(DespeckledVolume, OfDustTheErrorAsksForTheLeast) {
  EXPECT_LE(advice_to_min(dusty(), {2, false}), 1.4);
}

}  // namespace
}  // namespace mw::io
