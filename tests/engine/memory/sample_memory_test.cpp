// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 6, of values of tets: what is set aside and told is no less than what is allocated.
#include "engine/sample/image_sampler.h"

#include <numeric>

#include "engine/window/window_memory.h"
#include "io/mesh/mesh_sink.h"
#include "tests/engine/memory/counted_memory.h"
#include "tests/engine/output/marched_blocks.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;

/// What the merge takes beside what it tells, see finish_memory_test.cpp.
constexpr std::uint64_t kFixedBytes = 128 << 10;

TEST(Promise6BoundedMemory, OfValuesOfTets) {
  std::mt19937 random(77);
  for (const Statistic statistic : {Statistic::kMean, Statistic::kMode}) {
    const Trial trial{
        .volume = random_volume_of(random, static_cast<VolumeKind>(0), {24, 20, 22}, 5),
        .settings = {.window = 16, .start = StartMesh::kDense},
        .frame = {}};
    const MemoryVolume file(trial.volume, trial.frame);
    const io::LabelTable table = io::collect_labels(file);
    const io::DenseVolume volume(file, table);
    MarchedBlocks blocks(trial, volume);
    // Each voxel has a value of its own, so that shares are as many as can be.
    SmallVolume numbers{.shape = {60, 50, 40}};
    numbers.labels.resize(static_cast<std::size_t>(numbers.shape.product()));
    std::iota(numbers.labels.begin(), numbers.labels.end(), 0);
    const auto image = std::make_shared<MemoryVolume>(numbers, Frame{.spacing = {0.4, 0.4, 0.55}});
    ImageSampler sampler({{.name = "x", .statistic = statistic, .image = image}}, file.info(), 2);
    std::uint64_t held = 0;
    OutputOptions options{.values = &sampler};
    options.hold = [&](std::uint64_t bytes) { held = std::max(held, bytes); };
    io::NoSink sink;
    const std::uint64_t before = mw::test::allocated_bytes();
    mw::test::start_peak();
    static_cast<void>(finish({blocks, blocks.grid(), volume}, sink, options));
    const std::uint64_t taken = mw::test::peak_allocated_bytes() - before;
    EXPECT_LE(taken, written_block_bytes(blocks.largest()) + 16 * table.size() + kFixedBytes +
                         held + sampler.buffer_bytes());
    EXPECT_GT(held, 100000U);
  }
}

}  // namespace
}  // namespace mw::engine
