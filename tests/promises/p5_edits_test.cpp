// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 5: a volume that was edited and is meshed from what an earlier run has kept gives the
// bytes of a run that begins afresh.
#include <atomic>

#include "engine/team/team_processes.h"
#include "tests/engine/keep/edits.h"
#include "tests/engine/memory_run.h"
#include "tests/engine/team/crowd.h"
#include "tests/temp_folder.h"
#include "tests/testing.h"

namespace mw::engine {
namespace {

using audit::test::random_shape;
using audit::test::random_volume_of;
using audit::test::VolumeKind;
using mw::test::TempFolder;
using test::below;
using test::Editor;
using test::expect_same;
using test::for_ranks;
using test::MemorySink;
using test::random_trial;
using test::run_in_memory;
using test::run_into;
using test::Trial;

struct Kept {
  io::MeshData mesh;
  KeepFacts facts;
};

Kept run_kept(const Trial& trial, const RunHooks& hooks) {
  MemorySink sink;
  const RunReport report = run_into(sink, trial, hooks);
  return {sink.mesh(), report.keep.value()};
}

std::uint64_t visited(const KeepFacts& facts) {
  std::uint64_t sum = 0;
  for (const KeepFacts::March& march : facts.marches) sum += march.visited;
  return sum;
}

std::uint64_t skipped(const KeepFacts& facts) {
  std::uint64_t sum = 0;
  for (const KeepFacts::March& march : facts.marches) sum += march.skipped;
  return sum;
}

/// A run that keeps what it does in a folder, on some threads.
RunHooks kept_in(const std::filesystem::path& folder, KeepUse use, int threads) {
  RunHooks hooks{.threads = threads};
  hooks.keep.folder = folder;
  hooks.keep.use = use;
  return hooks;
}

/// What a chain of edits adds up to.
struct Chain {
  std::uint64_t visited = 0;
  std::uint64_t skipped = 0;
};

/// Edits the volume and returns what it did.
using Edit = std::function<std::string(test::SmallVolume& volume)>;

void run_chain(Trial trial, std::mt19937& random, int edits, const Edit& edit, Chain& chain) {
  const TempFolder folder;
  KeepUse use = KeepUse::kBegin;
  std::string done = "begun";
  for (int i = 0; i <= edits && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(done + ", edit " + std::to_string(i) + ": " + trial.text());
    const int threads = static_cast<int>(1 + below(random, 4));
    const Kept kept = run_kept(trial, kept_in(folder.path() / "kept", use, threads));
    expect_same(kept.mesh, run_in_memory(trial));
    if (i == 0) {
      EXPECT_EQ(skipped(kept.facts), 0U);
    } else {
      chain.visited += visited(kept.facts);
      chain.skipped += skipped(kept.facts);
    }
    use = KeepUse::kUpdate;
    done = edit(trial.volume);
  }
}

/// Edits of every kind.
Edit any_edit(Editor& editor) {
  return [&editor](test::SmallVolume& volume) {
    Box3 box;
    return editor.edit(volume, box);
  };
}

/// A dot of one label somewhere, in the place of one that was there before.
class Dot {
 public:
  Dot(std::mt19937& random, Label label) : random_(random), label_(label) {}

  std::string move(test::SmallVolume& volume) {
    for (const auto& [at, label] : covered_) volume.labels[at] = label;
    covered_.clear();
    const auto x = std::int64_t{below(random_, static_cast<std::uint32_t>(volume.shape.x - 1))};
    const Box3 all{{0, 0, 0}, volume.shape}, dot{{x, 4, 4}, {x + 2, 6, 6}};
    for_each_index(dot, [&](Index3 v) {
      const auto at = static_cast<std::size_t>(all.offset(v));
      covered_.emplace_back(at, std::exchange(volume.labels[at], label_));
    });
    return "a dot at " + std::to_string(x);
  }

 private:
  std::mt19937& random_;
  Label label_;
  std::vector<std::pair<std::size_t, Label>> covered_;  ///< and what was there
};

TEST(Promise5SameBytes, AfterEditsFromWhatWasKept) {
  std::mt19937 random(3501);
  Chain chain;
  for (std::uint32_t i = 0; i < 12 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 10, 19);
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    Trial trial = random_trial(
        random, test::with_room(random_volume_of(random, kind, shape, 2 + below(random, 120))));
    constexpr std::array<int, 3> kWindows{4, 6, 8};
    trial.settings.window = kWindows[below(random, 3)];
    trial.settings.marches = static_cast<int>(1 + below(random, 2));
    trial.settings.order = Order::kColour;
    Editor editor(random);
    run_chain(std::move(trial), random, 5, any_edit(editor), chain);
  }
  EXPECT_GT(chain.skipped, chain.visited / 2);
  EXPECT_GT(chain.visited, 100U);
  RecordProperty("visited", std::to_string(chain.visited));
  RecordProperty("skipped", std::to_string(chain.skipped));
}

/// Windows see labels beyond the faces of a cell that repeats itself, which are those of its other
/// side.
TEST(Promise5SameBytes, AfterEditsOfCellsThatRepeatThemselves) {
  std::mt19937 random(3507);
  Chain chain;
  for (std::uint32_t i = 0; i < 8 && !HasFailure(); ++i) {
    const Index3 shape = i % 2 == 0 ? Index3{56, 10, 8} : Index3{12, 10, 40};
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    Trial trial = random_trial(
        random, test::with_room(random_volume_of(random, kind, shape, 2 + below(random, 20))));
    trial.settings.edge_variance.reset();
    trial.settings.target_reduction.reset();
    trial.settings.window = 4;
    trial.settings.marches = static_cast<int>(1 + below(random, 2));
    trial.settings.order = Order::kColour;
    trial.settings.periodic = i < 4 ? 7 : 1 + below(random, 7);
    if (i % 4 == 3) trial.settings.sizes.rules.others = 3.0;
    Editor editor(random);
    run_chain(std::move(trial), random, 4, any_edit(editor), chain);
  }
  EXPECT_GT(chain.skipped, 50U);
  EXPECT_GT(chain.visited, 100U);
  RecordProperty("visited", std::to_string(chain.visited));
  RecordProperty("skipped", std::to_string(chain.skipped));
}

/// Interfaces that are fitted to a source surface look farther than the bound does, and the limits
/// of a label with a small size reach twenty voxels out of it where they grow slowly.  The volume
/// is long, so that most windows are beyond what an edit reaches.
TEST(Promise5SameBytes, AfterEditsFromWhatWasKeptWithSizes) {
  std::mt19937 random(3502);
  Chain chain;
  for (int i = 0; i < 6 && !HasFailure(); ++i) {
    Trial trial{.volume = test::with_room(random_volume_of(random, VolumeKind::kBlobs, {72, 10, 10},
                                                           4 + below(random, 4))),
                .settings = {.window = 4, .marches = 1, .order = Order::kColour},
                .frame = {}};
    constexpr Label kDot = 1;  // between those that with_room() leaves
    const bool is_slow = i % 2 == 1;
    trial.settings.sizes = {
        .rules = {.labels = {{test::raw_label(kDot), 1.6}}, .others = is_slow ? 4.0 : 2.5},
        .gradation = is_slow ? 0.1 : 1.0};
    Editor editor(random);
    Dot dot(random, kDot);
    dot.move(trial.volume);
    const Edit move = [&](test::SmallVolume& volume) { return dot.move(volume); };
    run_chain(std::move(trial), random, 3, is_slow ? move : any_edit(editor), chain);
  }
  EXPECT_GT(chain.skipped, 20U);
  EXPECT_GT(chain.visited, 100U);
}

std::uint64_t bytes_in(const std::filesystem::path& folder) {
  std::uint64_t sum = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) sum += entry.file_size();
  return sum;
}

/// The folder holds less than windows left, so some are visited again to make what is gone.
TEST(Promise5SameBytes, AfterEditsFromFoldersThatHadToShrink) {
  std::mt19937 random(3505);
  std::uint64_t again = 0, skips = 0;
  for (std::uint32_t i = 0; i < 6 && !HasFailure(); ++i) {
    Trial trial =
        random_trial(random, test::with_room(random_volume_of(
                                 random, static_cast<VolumeKind>(i % audit::test::kVolumeKinds),
                                 {32, 10, 8}, 2 + i % 7)));
    trial.settings.window = 4;
    trial.settings.marches = static_cast<int>(1 + i % 2);
    trial.settings.order = Order::kColour;
    const TempFolder folder;
    const std::filesystem::path whole = folder.path() / "whole", small = folder.path() / "small";
    run_kept(trial, kept_in(whole, KeepUse::kBegin, 2));
    RunHooks begin = kept_in(small, KeepUse::kBegin, 2);
    begin.keep.bytes = bytes_in(whole) * (10 + below(random, 80)) / 100;
    run_kept(trial, begin);
    EXPECT_LT(bytes_in(small), bytes_in(whole));
    Editor editor(random);
    for (int edit = 0; edit < 3 && !HasFailure(); ++edit) {
      Box3 box;
      SCOPED_TRACE(editor.edit(trial.volume, box) + ", edit " + std::to_string(edit) + ": " +
                   trial.text());
      const Kept of_whole = run_kept(trial, kept_in(whole, KeepUse::kUpdate, 2));
      const Kept of_small = run_kept(trial, kept_in(small, KeepUse::kUpdate, 1 + edit % 3));
      expect_same(of_small.mesh, run_in_memory(trial));
      EXPECT_GE(visited(of_small.facts), visited(of_whole.facts));
      again += visited(of_small.facts) - visited(of_whole.facts);
      skips += skipped(of_small.facts);
    }
  }
  EXPECT_GT(again, 100U);
  EXPECT_GT(skips, 100U);
}

/// A run of several processes that keep what they do; a visit of the last one fails, if asked.
/// Returns the mesh of the first, and nothing of a run that fails.
std::optional<Kept> run_shared(const Trial& trial, const std::filesystem::path& folder, int ranks,
                               std::uint32_t seed, std::optional<int> failing_visit) {
  std::optional<Kept> out;
  for_ranks({.ranks = ranks, .seed = seed}, [&](Team& team) {
    TeamProcesses processes(team);
    RunHooks hooks = kept_in(folder, KeepUse::kBegin, 1 + team.rank() % 2);
    hooks.processes = &processes;
    std::atomic<int> visits = 0;
    hooks.before_visit = [&](Index3) {
      if (team.rank() == ranks - 1 && visits++ == failing_visit) throw std::bad_alloc();
    };
    try {
      MemorySink sink;
      const RunReport report = run_into(sink, trial, hooks);
      if (team.is_first()) out = {sink.mesh(), report.keep.value()};
    } catch (const std::exception&) {
      EXPECT_TRUE(failing_visit.has_value());
    }
  });
  return out;
}

/// Volumes that several rows of windows cover, so that processes share them.
Trial shared_trial(std::mt19937& random, std::uint32_t i) {
  const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
  Trial trial = random_trial(
      random, test::with_room(random_volume_of(random, kind, {10, 20, 16}, 2 + i % 7)));
  trial.settings.window = 4;
  trial.settings.marches = static_cast<int>(1 + i % 3);
  trial.settings.order = Order::kColour;
  return trial;
}

TEST(Promise5SameBytes, AfterEditsFromWhatSeveralProcessesHaveKept) {
  std::mt19937 random(3503);
  for (std::uint32_t i = 0; i < 8 && !HasFailure(); ++i) {
    Trial trial = shared_trial(random, i);
    SCOPED_TRACE(trial.text());
    const TempFolder folder;
    const std::filesystem::path kept = folder.path() / "kept";
    const int ranks = static_cast<int>(2 + i % 3);
    const auto begun = run_shared(trial, kept, ranks, i, std::nullopt);
    ASSERT_TRUE(begun.has_value());
    expect_same(begun->mesh, run_in_memory(trial));
    const Kept again = run_kept(trial, kept_in(kept, KeepUse::kUpdate, 2));
    expect_same(again.mesh, begun->mesh);
    EXPECT_EQ(visited(again.facts), 0U);
    EXPECT_EQ(skipped(again.facts), visited(begun->facts));
    Editor editor(random);
    Box3 box;
    SCOPED_TRACE(editor.edit(trial.volume, box));
    const Kept edited = run_kept(trial, kept_in(kept, KeepUse::kUpdate, 2));
    expect_same(edited.mesh, run_in_memory(trial));
  }
}

TEST(Promise5SameBytes, GoingOnFromWhatSeveralProcessesHadKeptWhenOneFailed) {
  std::mt19937 random(3504);
  std::uint64_t taken = 0;
  for (std::uint32_t i = 0; i < 8 && !HasFailure(); ++i) {
    const Trial trial = shared_trial(random, i);
    SCOPED_TRACE(trial.text());
    const TempFolder folder;
    const std::filesystem::path kept = folder.path() / "kept";
    const int visits = static_cast<int>(4 + below(random, 12));
    EXPECT_FALSE(run_shared(trial, kept, static_cast<int>(2 + i % 3), i, visits).has_value());
    const Kept rest = run_kept(trial, kept_in(kept, KeepUse::kGoOn, 2));
    expect_same(rest.mesh, run_in_memory(trial));
    taken += skipped(rest.facts);
  }
  // How far the other processes come before one fails is up to the scheduler.
  EXPECT_GT(taken, 0U);
}

}  // namespace
}  // namespace mw::engine
