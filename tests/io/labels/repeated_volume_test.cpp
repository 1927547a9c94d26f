// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxels of a cell's copies are those of the cell.
#include "io/labels/repeated_volume.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/io/labels/memory_volume.h"
#include "tests/oracle/small_volumes.h"

namespace mw::io {
namespace {

using audit::test::below;

std::int64_t wrapped(std::int64_t at, std::int64_t voxels) {
  return (at % voxels + voxels) % voxels;
}

TEST(PeriodicVolume, RepeatsTheCell) {
  std::mt19937 random(711);
  for (int i = 0; i < 60; ++i) {
    const auto draw = [&](std::uint32_t most) { return std::int64_t{below(random, most)}; };
    const Index3 shape{1 + draw(7), 1 + draw(7), 1 + draw(7)}, margin{draw(20), draw(3), draw(9)};
    std::vector<RawLabel> labels(static_cast<std::size_t>(shape.product()));
    for (RawLabel& label : labels) label = below(random, 5);
    const Box3 cell{{0, 0, 0}, shape};
    const MemoryVolume memory(shape, VoxelType::kU8, labels);
    const PeriodicVolume volume(memory, margin);
    EXPECT_EQ(volume.info().shape, shape + margin + margin);
    const Box3 box = random_box(random, volume.info().shape);
    std::vector<RawLabel> read(static_cast<std::size_t>(box.voxels()));
    volume.read(box, read);
    std::size_t next = 0;
    for_each_index(box, [&](Index3 v) {
      const Index3 at = v - margin;
      const Index3 inside{wrapped(at.x, shape.x), wrapped(at.y, shape.y), wrapped(at.z, shape.z)};
      EXPECT_EQ(read[next++], labels[static_cast<std::size_t>(cell.offset(inside))]);
    });
  }
}

/// A volume of labels with as many scores as labels; a voxel of scores is one of labels.
class ScoredVolume : public MemoryVolume, public LabelScores {
 public:
  using MemoryVolume::MemoryVolume;
  [[nodiscard]] const LabelScores* scores() const override { return this; }
  [[nodiscard]] Index3 shape() const override { return info().shape; }
  [[nodiscard]] std::size_t labels() const override { return 5; }
  void read_scores(RawLabel label, const Box3& box, std::span<double> out) const override {
    std::vector<RawLabel> labels(out.size());
    read(box, labels);
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = 10.0 * static_cast<double>(label + labels[i]);
  }
};

TEST(PeriodicVolume, RepeatsScores) {
  std::mt19937 random(712);
  const Index3 shape{4, 5, 6}, margin{9, 0, 7};
  std::vector<RawLabel> labels(static_cast<std::size_t>(shape.product()));
  for (RawLabel& label : labels) label = below(random, 5);
  const ScoredVolume cell(shape, VoxelType::kU8, labels);
  const PeriodicVolume volume(cell, margin);
  ASSERT_NE(volume.scores(), nullptr);
  EXPECT_EQ(volume.scores()->shape(), volume.info().shape);
  for (int i = 0; i < 40; ++i) {
    const Box3 box = random_box(random, volume.info().shape);
    std::vector<RawLabel> read(static_cast<std::size_t>(box.voxels()));
    std::vector<double> scores(read.size());
    volume.read(box, read);
    volume.scores()->read_scores(3, box, scores);
    for (std::size_t k = 0; k < read.size(); ++k) {
      EXPECT_EQ(scores[k], 10.0 * static_cast<double>(3 + read[k]));
    }
  }
}

}  // namespace
}  // namespace mw::io
