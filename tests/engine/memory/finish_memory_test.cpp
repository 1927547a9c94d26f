// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 6, of the merge: what it says that it remembers, and what is set aside for blocks, is
// no less than what it allocates.
#include "engine/output/finish.h"
#include "engine/window/window_memory.h"
#include "io/mesh/mesh_sink.h"
#include "tests/engine/memory/counted_memory.h"
#include "tests/engine/output/marched_blocks.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;

/// What the histogram, lines of homes and lists of blocks of a few vertices take.
constexpr std::uint64_t kFixedBytes = 128 << 10;
/// What a vertex takes in VertexRows while a list is merged.
constexpr std::uint64_t kBytesPerRemembered = 32;

void expect_held(const Trial& trial, WorkInOrder work) {
  const MemoryVolume file(trial.volume, trial.frame);
  const io::LabelTable table = io::collect_labels(file);
  const io::DenseVolume volume(file, table);
  MarchedBlocks blocks(trial, volume);
  const std::uint64_t aside =
      work.at_once * written_block_bytes(blocks.largest()) + 16 * table.size() + kFixedBytes;
  std::uint64_t held = 0;
  OutputOptions options{.work = work};
  options.hold = [&](std::uint64_t bytes) { held = bytes; };
  io::NoSink sink;
  const std::uint64_t before = mw::test::allocated_bytes();
  mw::test::start_peak();
  const FinishedMesh finished = finish({blocks, blocks.grid(), volume}, sink, options);
  const std::uint64_t taken = mw::test::peak_allocated_bytes() - before;
  const std::uint64_t remembered = kBytesPerRemembered * finished.max_remembered;
  EXPECT_LE(remembered, held);
  EXPECT_LE(taken, aside + remembered);
}

TEST(Promise6BoundedMemory, OfTheMerge) {
  std::mt19937 random(4021);
  for (std::uint32_t kind = 0; kind < audit::test::kVolumeKinds; ++kind) {
    for (const StartMesh start : {StartMesh::kCoarse, StartMesh::kDense}) {
      const auto edge = [&] { return 16 + std::int64_t{below(random, 9)}; };
      const Trial trial{.volume = random_volume_of(random, static_cast<VolumeKind>(kind),
                                                   {edge(), edge(), edge()}, 2 + below(random, 6)),
                        .settings = {.window = below(random, 2) == 0 ? 8 : 32, .start = start},
                        .frame = {}};
      expect_held(trial, {.at_once = 1});
      expect_held(trial, {.threads = 3, .at_once = 4});
      EXPECT_FALSE(testing::Test::HasFailure()) << trial.text();
    }
  }
}

}  // namespace
}  // namespace mw::engine
