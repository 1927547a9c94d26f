// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 6, piece by piece: what a run sets aside for windows, for the making of labels and for
// the merge is no less than what these allocate, whatever the volume, the start mesh and the
// settings.
#include "engine/window/window_memory.h"

#include "engine/store/run_store.h"
#include "engine/system/crew.h"
#include "engine/window/window_order.h"
#include "engine/window/window_visitor.h"
#include "tests/engine/memory/counted_memory.h"
#include "tests/engine/memory_run.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace mw::test;
using namespace test;

constexpr std::array<StartMesh, 3> kStarts{StartMesh::kCoarse, StartMesh::kOctree,
                                           StartMesh::kDense};

/// What a piece of work allocated at most, beside what was there before.
template <typename Work>
std::uint64_t peak_of(Work work) {
  const std::uint64_t before = allocated_bytes();
  start_peak();
  work();
  return peak_allocated_bytes() - before;
}

/// The marches of a run, each visit held to its bound.  Returns the largest share of a bound that
/// was taken.
class HeldRun {
 public:
  /// The trial outlives it.
  explicit HeldRun(const Trial& trial)
      : volume_(trial.volume, trial.frame),
        table_(io::collect_labels(volume_)),
        dense_(volume_, table_),
        settings_(trial.settings),
        layout_(grids(trial), trial.settings.order),
        store_(layout_, budget_, nullptr) {}

  double march() {
    std::optional<PreparedLabels> labels;
    EXPECT_LE(peak_of([&] { labels.emplace(dense_, settings_); }),
              prepared_label_bytes(layout_.grid(0).volume(), settings_.sizes.rules.any()) +
                  preparation_bytes(settings_));
    double worst = 0.0;
    for (std::uint32_t m = 0; m < layout_.marches(); ++m) {
      worst = std::max(worst, march(m, *labels));
    }
    return worst;
  }

  /// Decoded size of the content of all windows together; tells whether a test is about anything.
  [[nodiscard]] std::uint64_t content() const { return content_; }

 private:
  static std::vector<WindowGrid> grids(const Trial& trial) {
    const int window = trial.settings.window;
    return {WindowGrid(trial.volume.shape, window), WindowGrid(trial.volume.shape, 2 * window)};
  }

  double march(std::uint32_t number, const PreparedLabels& labels) {
    const WindowGrid& grid = layout_.grid(number);
    BlockStore& blocks = store_.march(number);
    const WindowOrder order(grid, settings_.order);
    VisitPlan plan{.seeding = tbb_for};
    if (number + 1 == layout_.marches()) plan.last = order;
    const WindowVisitor visitor(labels, Metric({1, 1, 1}), settings_, grid, blocks,
                                std::move(plan));
    const WindowNeeds needs{.start_size = [&](Index3 b) { return visitor.start_size(b); },
                            .max_distance = settings_.max_distance,
                            .has_source = visitor.has_source()};
    double worst = 0.0;
    for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
      const Index3 window = order.window(rank);
      const std::uint64_t bound = window_bytes(grid, window, blocks, needs);
      const std::uint64_t taken = peak_of([&] { visitor.visit(window); });
      EXPECT_LE(taken, bound) << "window " << window.x << " " << window.y << " " << window.z;
      worst = std::max(worst, static_cast<double>(taken) / static_cast<double>(bound));
      content_ += blocks.taken_bytes(window);
    }
    return worst;
  }

  MemoryVolume volume_;
  io::LabelTable table_;
  io::DenseVolume dense_;
  MeshSettings settings_;
  RunLayout layout_;
  MemoryBudget budget_;
  RunStore store_;
  std::uint64_t content_ = 0;
};

TEST(WindowMemory, BoundsWhatVisitsAllocateOnAllKindsOfVolumes) {
  std::mt19937 random(4011);
  for (std::uint32_t kind = 0; kind < audit::test::kVolumeKinds; ++kind) {
    for (const StartMesh start : kStarts) {
      const auto edge = [&]() -> std::int64_t { return 9 + below(random, 14); };
      Trial trial{.volume = random_volume_of(random, static_cast<VolumeKind>(kind),
                                             {edge(), edge(), edge()}, 2 + below(random, 6)),
                  .settings = {.window = below(random, 2) == 0 ? 8 : 16, .start = start},
                  .frame = {}};
      if (below(random, 3) == 0) trial.settings.max_distance.reset();
      if (below(random, 3) == 0) trial.settings.topology = KeptTopology::kInterfaces;
      if (below(random, 2) == 0) trial.settings.sizes.rules.others = 2.0 + below(random, 4);
      HeldRun run(trial);
      run.march();
      EXPECT_FALSE(testing::Test::HasFailure()) << trial.text();
      EXPECT_GT(run.content(), 0U);
    }
  }
}

/// The kinds that take the most for their content: windows full of interfaces, and a window whose
/// one block has eight parts.  The bound is not out of all proportion, either.
TEST(WindowMemory, BoundsTheWorstVolumesClosely) {
  const auto board = audit::test::volume_from(
      {25, 25, 25}, 2, [](auto x, auto y, auto z) { return (x + y + z) % 2; });
  const auto all_different = audit::test::volume_from(
      {24, 24, 24}, 24 * 24 * 24, [](auto x, auto y, auto z) { return (z * 24 + y) * 24 + x; });
  std::mt19937 random(4012);
  const auto noise = random_volume_of(random, VolumeKind::kNoise, {24, 24, 24}, 2);
  for (const auto& volume : {board, all_different, noise}) {
    for (const StartMesh start : kStarts) {
      const Trial trial{.volume = volume, .settings = {.window = 32, .start = start}, .frame = {}};
      HeldRun run(trial);
      const double share = run.march();
      EXPECT_GT(share, 0.4);
    }
  }
}

/// A large bound lets meshes become coarse, while labels are read ever farther around them: then
/// labels take more than the content.
TEST(WindowMemory, BoundsTheLabelsThatLargeDistancesRead) {
  std::mt19937 random(4014);
  for (const double distance : {3.0, 6.0, 16.0}) {
    for (const VolumeKind kind : {VolumeKind::kBlobs, VolumeKind::kSheets}) {
      const auto edge = [&]() -> std::int64_t { return 16 + below(random, 12); };
      Trial trial{
          .volume = random_volume_of(random, kind, {edge(), edge(), edge()}, 2 + below(random, 4)),
          .settings = {.window = below(random, 2) == 0 ? 8 : 16},
          .frame = {}};
      trial.settings.max_distance = distance;
      HeldRun run(trial);
      run.march();
      EXPECT_FALSE(testing::Test::HasFailure()) << trial.text();
    }
  }
}

/// Slack for a few small windows is in window_bytes(); the size of a start mesh is exact.
TEST(WindowMemory, KnowsTheSizeOfStartMeshesBeforeTheyAreMade) {
  std::mt19937 random(4013);
  for (int i = 0; i < 60; ++i) {
    const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
    const Trial trial{.volume = random_volume_of(random, kind, {18, 17, 11}, 5),
                      .settings = {.window = 16, .start = kStarts[below(random, 3)]},
                      .frame = {}};
    const MemoryVolume volume(trial.volume, trial.frame);
    const io::LabelTable table = io::collect_labels(volume);
    const io::DenseVolume dense(volume, table);
    const PreparedLabels labels(dense, trial.settings);
    const WindowGrid grid(trial.volume.shape, trial.settings.window);
    const RunLayout layout({grid}, Order::kRaster);
    MemoryBudget budget;
    RunStore store(layout, budget, nullptr);
    const WindowVisitor visitor(labels, Metric({1, 1, 1}), trial.settings, grid, store.march(0));
    for_each_index(grid.blocks(), [&](Index3 b) {
      const StartSize size = visitor.start_size(b);
      const BlockMesh mesh = visitor.start(b);
      EXPECT_EQ(size.vertices, mesh.vertices.size());
      EXPECT_EQ(size.tets, mesh.tets.size());
      EXPECT_GE(size.samples, mesh.samples.size());
      const StartSize max = max_start_size(grid, b);
      EXPECT_GE(max.vertices, size.vertices);
      EXPECT_GE(max.tets, size.tets);
      EXPECT_GE(max.samples, size.samples);
    });
  }
}

}  // namespace
}  // namespace mw::engine
