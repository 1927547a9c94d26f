// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 6, of the merge: what it says that it remembers, and what is set aside for blocks, is
// no less than what it allocates.
#include "engine/team/output/part_rows.h"
#include "engine/window/window_memory.h"
#include "io/mesh/mesh_sink.h"
#include "tests/engine/memory/counted_memory.h"
#include "tests/engine/output/marched_blocks.h"
#include "tests/engine/output/scattered.h"

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

// Promise 6, of what processes tell one another before they write a mesh together: no more than is
// set aside for it.

/// Lists of a few numbers, of lines and ranks.
constexpr std::uint64_t kListBytes = 64 << 10;

std::vector<std::vector<Claim>> claims_of(const Scattered& scattered, const LineShare& share,
                                          VertexUses& uses, std::uint64_t& held) {
  Claims claims(share, uses, [&](std::uint64_t bytes) { held = std::max(held, bytes); });
  for_each_own_block(
      share, [](std::size_t) {},
      [&](Index3 b) {
        uses.add(b, uses.lines_of(scattered.at(b)));
        claims.add(b, scattered.at(b));
      });
  return claims.take(2);
}

std::uint64_t size_of(const std::vector<std::vector<Claim>>& claims) {
  std::uint64_t out = 0;
  for (const auto& of_rank : claims) out += of_rank.size();
  return out;
}

/// Peak of what `act` allocates.
template <typename Act>
std::uint64_t taken_by(Act act) {
  const std::uint64_t before = mw::test::allocated_bytes();
  mw::test::start_peak();
  act();
  return mw::test::peak_allocated_bytes() - before;
}

/// Two processes with lines at random, so that nearly every vertex is told.
TEST(Promise6BoundedMemory, OfWhatProcessesTellOneAnother) {
  std::mt19937 random(4031);
  for (std::uint32_t i = 0; i < 12; ++i) {
    const Scattered scattered =
        test::scatter_vertices(random, {8, 20, 20}, 1 + i % 3, 4000 * (1 + i % 4));
    const Index3 blocks = scattered.grid.blocks();
    std::vector<std::uint32_t> owners;
    for (std::int64_t line = 0; line < blocks.y * blocks.z; ++line) {
      owners.push_back(below(random, 2));
    }
    const LineShare share(blocks, owners, 0), other(blocks, owners, 1);
    VertexUses uses(scattered.grid), other_uses(scattered.grid);
    std::uint64_t held = 0, unused = 0;
    std::vector<std::vector<Claim>> mine;
    const std::uint64_t claiming =
        taken_by([&] { mine = claims_of(scattered, share, uses, held); });
    EXPECT_LE(claiming, held + kListBytes);
    const auto others = claims_of(scattered, other, other_uses, unused);
    const std::vector<std::vector<Claim>> theirs{{}, others[0]};
    ASSERT_GT(size_of(mine) + size_of(theirs), 2000U);
    const std::uint64_t told = kBytesPerClaim * size_of(mine) + kBytesPerJudged * size_of(theirs);
    std::size_t remembered = 0;
    const std::uint64_t taken = taken_by([&] {
      PartRows rows(share, uses, mine, theirs);
      for_each_own_block(
          share, [](std::size_t) {},
          [&](Index3 b) {
            rows.count(b, scattered.at(b));
            remembered = std::max(remembered, rows.remembered());
          });
      const ClaimLists firsts = rows.firsts();
      ClaimLists answers;
      for (const auto& of_rank : mine) answers.emplace_back(of_rank.size(), 0);
      rows.take_firsts(answers);
    });
    EXPECT_LE(taken, told + kBytesPerRemembered * remembered + kListBytes);
  }
}

}  // namespace
}  // namespace mw::engine
