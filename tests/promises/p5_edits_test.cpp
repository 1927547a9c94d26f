// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 5: a volume that was edited and is meshed from what an earlier run has kept gives the
// bytes of a run that begins afresh.
#include <gtest/gtest.h>

#include "tests/engine/keep/edits.h"
#include "tests/engine/memory_run.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using audit::test::random_volume_of;
using audit::test::VolumeKind;
using mw::test::TempFolder;
using test::below;
using test::Editor;
using test::expect_same;
using test::MemorySink;
using test::MemoryVolume;
using test::random_trial;
using test::run_in_memory;
using test::Trial;

struct Kept {
  io::MeshData mesh;
  KeepFacts facts;
};

Kept run_kept(const Trial& trial, const RunHooks& hooks) {
  const MemoryVolume volume(trial.volume, trial.frame);
  const io::LabelTable table = io::collect_labels(volume);
  MemorySink sink;
  const RunReport report = mesh_volume(io::DenseVolume(volume, table), trial.settings, sink, hooks);
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

void run_chain(Trial trial, std::mt19937& random, int edits, Chain& chain) {
  const TempFolder folder;
  Editor editor(random);
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
    Box3 box;
    done = editor.edit(trial.volume, box);
  }
}

TEST(Promise5SameBytes, AfterEditsFromWhatWasKept) {
  std::mt19937 random(3501);
  Chain chain;
  for (std::uint32_t i = 0; i < 12 && !HasFailure(); ++i) {
    const auto edge = [&] { return std::int64_t{10 + below(random, 10)}; };
    const auto x = edge(), y = edge(), z = edge();
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    Trial trial = random_trial(
        random, test::with_room(random_volume_of(random, kind, {x, y, z}, 2 + below(random, 120))));
    constexpr std::array<int, 3> kWindows{4, 6, 8};
    trial.settings.window = kWindows[below(random, 3)];
    trial.settings.marches = static_cast<int>(1 + below(random, 2));
    trial.settings.order = Order::kColour;
    run_chain(std::move(trial), random, 5, chain);
  }
  EXPECT_GT(chain.skipped, chain.visited / 2);
  EXPECT_GT(chain.visited, 100U);
  RecordProperty("visited", std::to_string(chain.visited));
  RecordProperty("skipped", std::to_string(chain.skipped));
}

}  // namespace
}  // namespace mw::engine
