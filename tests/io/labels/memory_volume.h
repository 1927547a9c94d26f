// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume in memory, for tests of what wraps volumes.
#pragma once

#include "io/volume/label_volume.h"
#include "kernels/core/index.h"
#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::io {

class MemoryVolume : public LabelVolume {
 public:
  MemoryVolume(Index3 shape, VoxelType type, std::vector<RawLabel> labels)
      : labels_(std::move(labels)) {
    info_.shape = shape;
    info_.type = type;
    info_.format = "memory";
  }
  [[nodiscard]] VolumeInfo& info() { return info_; }
  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  [[nodiscard]] const std::vector<RawLabel>& labels() const { return labels_; }
  void set(Index3 v, RawLabel label) {
    labels_[static_cast<std::size_t>(Box3{{0, 0, 0}, info_.shape}.offset(v))] = label;
  }
  [[nodiscard]] RawLabel at(Index3 v) const {
    const Box3 all{{0, 0, 0}, info_.shape};
    EXPECT_TRUE(all.contains(v)) << "read outside the volume";
    return labels_[static_cast<std::size_t>(all.offset(v))];
  }
  void read(const Box3& box, std::span<RawLabel> out) const override {
    std::size_t next = 0;
    for_each_index(box, [&](Index3 v) { out[next++] = at(v); });
    EXPECT_EQ(next, out.size());
  }

 private:
  VolumeInfo info_;
  std::vector<RawLabel> labels_;
};

/// With the label raw[l] for each dense label l.
inline MemoryVolume volume_of(const audit::test::SmallVolume& small, VoxelType type,
                              const std::vector<RawLabel>& raw) {
  std::vector<RawLabel> labels;
  for (const Label label : small.labels) labels.push_back(raw[label]);
  return {small.shape, type, std::move(labels)};
}

/// Half-open and not empty.
inline Box3 random_box(std::mt19937& random, Index3 shape) {
  const auto below = [&](std::int64_t count) {
    return std::int64_t{audit::test::below(random, static_cast<std::uint32_t>(count))};
  };
  const Index3 lo{below(shape.x), below(shape.y), below(shape.z)};
  return {lo, lo + Index3{1 + below(shape.x - lo.x), 1 + below(shape.y - lo.y),
                          1 + below(shape.z - lo.z)}};
}

/// Expects that reads of a random box are what `all`, x fastest, has there.
inline void expect_box(const LabelVolume& volume, const std::vector<RawLabel>& all,
                       std::mt19937& random) {
  const Box3 whole{{0, 0, 0}, volume.info().shape};
  const Box3 box = random_box(random, whole.hi);
  std::vector<RawLabel> wanted, found(static_cast<std::size_t>(box.voxels()));
  for_each_index(
      box, [&](Index3 v) { wanted.push_back(all[static_cast<std::size_t>(whole.offset(v))]); });
  volume.read(box, found);
  EXPECT_EQ(found, wanted);
}

}  // namespace mw::io
