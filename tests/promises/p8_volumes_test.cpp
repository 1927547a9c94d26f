// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 8 end to end: the volumes that a run reports are exact.
#include "kernels/core/lattice.h"
#include "tests/engine/figures_of.h"
#include "tests/engine/memory_run.h"
#include "tests/oracle/whole_audit.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;

TEST(Promise8Volumes, OfARunAddUpToTheBoxAndAreThoseOfItsMesh) {
  std::mt19937 random(831);
  for (std::uint32_t i = 0; i < 24 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 4, 23);
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    const Trial trial = random_trial(random, random_volume_of(random, kind, shape, 1 + i % 6));
    SCOPED_TRACE(trial.text());
    MemorySink sink;
    const RunReport report = run_into(sink, trial, {.threads = 1 + static_cast<int>(i % 2)});
    const MemoryVolume file(trial.volume, trial.frame);
    const io::LabelTable table = io::collect_labels(file);
    const auto sums = figures_of(sink.mesh(), io::DenseVolume(file, table)).label_volumes6;
    const Int128 total = std::accumulate(sums.begin(), sums.end(), Int128{0});
    EXPECT_TRUE(total == Int128{kVoxelVolume6} * shape.product());
    const audit::VolumeReport expected =
        measure_volumes(trial.volume.view(), trial.volume.label_count,
                        test::small_mesh(sink.mesh()).view(), trial.frame);
    EXPECT_TRUE(expected.exact);
    ASSERT_EQ(expected.per_label.size(), sums.size());
    for (Label rank = 0; rank < sums.size(); ++rank) {
      const audit::VolumeRow& row = expected.per_label[rank];
      EXPECT_EQ(report.label_voxels[rank], row.voxels);
      EXPECT_EQ(audit::volume_row(rank, row.voxels, sums[rank]).error, row.error);
    }
  }
}

}  // namespace
}  // namespace mw::engine
