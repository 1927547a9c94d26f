// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 6, of the merge: what it says that it remembers, and what is set aside for one block, is
// no less than what it allocates, all figures of a report included.
#include "engine/output/finish.h"

#include "engine/march/window_order.h"
#include "engine/store/run_store.h"
#include "engine/window/window_memory.h"
#include "engine/window/window_visitor.h"
#include "tests/engine/memory/counted_memory.h"
#include "tests/engine/memory_run.h"

namespace mw::engine {
namespace {

using audit::test::below;
using audit::test::random_volume_of;
using audit::test::VolumeKind;
using test::MemoryVolume;
using test::Trial;

/// Keeps nothing.
class NoSink : public io::MeshSink {
 public:
  void begin(const io::MeshHeader&) override {}
  void write_vertices(std::span<const io::Position>) override {}
  void write_tets(std::span<const io::TetRows>, std::span<const RawLabel>) override {}
  void finish() override {}
};

/// The blocks after one march.
class MarchedStore : public FinalBlocks {
 public:
  MarchedStore(const Trial& trial, const io::DenseVolume& volume)
      : layout_({WindowGrid(trial.volume.shape, trial.settings.window)}, trial.settings.order),
        store_(layout_, budget_, nullptr) {
    const PreparedLabels labels(volume, trial.settings);
    const WindowVisitor visitor(labels, Metric(trial.frame.spacing), trial.settings, grid(),
                                store_.march(0));
    const WindowOrder order(grid(), trial.settings.order);
    for (std::uint64_t rank = 0; rank < order.size(); ++rank) visitor.visit(order.window(rank));
  }

  [[nodiscard]] BlockMesh load(Index3 block) override { return store_.march(0).load(block); }
  [[nodiscard]] const WindowGrid& grid() const { return layout_.grid(0); }
  [[nodiscard]] std::uint64_t largest() {
    std::uint64_t out = 0;
    for_each_index(grid().blocks(),
                   [&](Index3 b) { out = std::max(out, store_.march(0).loaded_bytes(b)); });
    return out;
  }

 private:
  RunLayout layout_;
  MemoryBudget budget_;
  RunStore store_;
};

/// Histogram, lines of homes, lists of blocks of a few vertices.
constexpr std::uint64_t kFixedBytes = 128 << 10;
/// Of a vertex in VertexRows, while a list is merged.
constexpr std::uint64_t kBytesPerRemembered = 32;

void expect_held(const Trial& trial, bool measured) {
  const MemoryVolume file(trial.volume, trial.frame);
  const io::LabelTable table = io::collect_labels(file);
  const io::DenseVolume volume(file, table);
  MarchedStore blocks(trial, volume);
  const std::uint64_t aside =
      written_block_bytes(blocks.largest()) + 16 * table.size() + kFixedBytes;
  std::uint64_t held = 0;
  OutputOptions options{.measure_quality = measured, .measure_shape = measured};
  options.hold = [&](std::uint64_t bytes) { held = bytes; };
  NoSink sink;
  const std::uint64_t before = mw::test::allocated_bytes();
  mw::test::start_peak();
  const FinishedMesh finished = finish({blocks, blocks.grid(), volume}, sink, options);
  const std::uint64_t taken = mw::test::peak_allocated_bytes() - before;
  const std::uint64_t remembered =
      kBytesPerRemembered * finished.max_remembered + finished.max_shape_bytes;
  EXPECT_LE(remembered, held);
  EXPECT_LE(taken, aside + remembered);
  EXPECT_EQ(finished.shape.has_value(), measured);
  EXPECT_TRUE(!measured || finished.shape->triangles > 0);
}

TEST(Promise6BoundedMemory, OfTheMergeWithAllFigures) {
  std::mt19937 random(4021);
  for (std::uint32_t kind = 0; kind < audit::test::kVolumeKinds; ++kind) {
    for (const StartMesh start : {StartMesh::kCoarse, StartMesh::kDense}) {
      const auto edge = [&] { return 16 + std::int64_t{below(random, 9)}; };
      const Trial trial{.volume = random_volume_of(random, static_cast<VolumeKind>(kind),
                                                   {edge(), edge(), edge()}, 2 + below(random, 6)),
                        .settings = {.window = below(random, 2) == 0 ? 8 : 32, .start = start},
                        .frame = {}};
      expect_held(trial, false);
      expect_held(trial, true);
      EXPECT_FALSE(testing::Test::HasFailure()) << trial.text();
    }
  }
}

}  // namespace
}  // namespace mw::engine
