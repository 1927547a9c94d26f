// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume cut into slabs of bounded size, and as runs of one label along x, plane by plane, of
// which two are held.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "io/volume/label_volume.h"
#include "kernels/core/index.h"

namespace mw::io {

/// The most voxels of a slab where labels are looked at once, slab by slab: 512 KiB of raw labels,
/// which stay in a second-level cache.
inline constexpr std::int64_t kSlabVoxels = 1 << 16;

/// Calls visit(Box3) on boxes that cover box in file order (x fastest), each of at most max_voxels
/// voxels or one row: whole planes, or rows of one plane.  Each is contiguous in an array over box.
template <class Visit>
void for_each_z_slab(const Box3& box, std::int64_t max_voxels, Visit visit) {
  const Index3 shape = box.shape();
  const std::int64_t rows = std::clamp<std::int64_t>(max_voxels / shape.x, 1, shape.y);
  const std::int64_t planes =
      rows == shape.y ? std::clamp<std::int64_t>(max_voxels / (shape.x * shape.y), 1, shape.z) : 1;
  for (std::int64_t z = box.lo.z; z < box.hi.z; z += planes) {
    for (std::int64_t y = box.lo.y; y < box.hi.y; y += rows) {
      visit(Box3{{box.lo.x, y, z},
                 {box.hi.x, std::min(y + rows, box.hi.y), std::min(z + planes, box.hi.z)}});
    }
  }
}

/// Does the same with slabs along x, for volumes whose fastest axis is z.
template <class Visit>
void for_each_x_slab(const Box3& box, std::int64_t max_voxels, Visit visit) {
  const auto turned = [](const Index3& v) { return Index3{v.z, v.y, v.x}; };
  for_each_z_slab(Box3{turned(box.lo), turned(box.hi)}, max_voxels, [&](const Box3& slab) {
    visit(Box3{turned(slab.lo), turned(slab.hi)});
  });
}

/// The voxels from begin to end - 1 of a row, which have one label, unlike those beside them.
struct LabelRun {
  std::int32_t begin = 0;
  std::int32_t end = 0;
  std::uint32_t part = 0;  ///< for the use of those that visit the runs
  RawLabel label = 0;
};

/// The runs of the first rows of a plane.  A row has all its runs, in ascending order.
class RunPlane {
 public:
  void clear() {
    runs_.clear();
    row_begin_.assign(1, 0);
  }
  void add_row(std::span<const RawLabel> labels);

  /// Returns the runs of a row, none for a row that is not there; they are invalid after add_row().
  [[nodiscard]] std::span<LabelRun> row(std::int64_t y) {
    const auto i = static_cast<std::size_t>(y);
    if (y < 0 || i + 1 >= row_begin_.size()) return {};
    return std::span(runs_).subspan(row_begin_[i], row_begin_[i + 1] - row_begin_[i]);
  }
  [[nodiscard]] std::span<LabelRun> all() { return runs_; }
  [[nodiscard]] std::uint64_t bytes() const { return runs_.capacity() * sizeof(LabelRun); }

 private:
  std::vector<LabelRun> runs_;
  std::vector<std::size_t> row_begin_ = {0};
};

/// The plane that is read, and the one before it.
struct RunPlanes {
  RunPlane current;
  RunPlane below;

  [[nodiscard]] std::uint64_t bytes() const { return current.bytes() + below.bytes(); }
};

/// Calls visit(other) for the runs of a row that overlap `run`; with reach 1 also for those that
/// touch it at an end.
template <class Visit>
void for_each_touching(std::span<LabelRun> row, const LabelRun& run, std::int32_t reach,
                       Visit visit) {
  const auto first = std::partition_point(row.begin(), row.end(), [&](const LabelRun& other) {
    return other.end + reach <= run.begin;
  });
  for (auto other = first; other != row.end() && other->begin < run.end + reach; ++other) {
    visit(*other);
  }
}

/// Reads the volume once in boxes of at most max_voxels (or a row), and calls row_read(planes, y,
/// z) after each row and plane_read(planes, z) after each plane. Memory: beside the box some 24
/// bytes a run of two planes, and 16 a row.
template <class RowRead, class PlaneRead>
void sweep_runs(const LabelVolume& volume, std::int64_t max_voxels, RowRead row_read,
                PlaneRead plane_read) {
  const Index3 shape = volume.info().shape;
  const auto row_voxels = static_cast<std::size_t>(shape.x);
  RunPlanes planes;
  std::vector<RawLabel> labels;
  for_each_z_slab({{0, 0, 0}, shape}, max_voxels, [&](const Box3& slab) {
    labels.resize(static_cast<std::size_t>(slab.voxels()));
    volume.read(slab, labels);
    std::span<const RawLabel> rest = labels;
    for (std::int64_t z = slab.lo.z; z < slab.hi.z; ++z) {
      for (std::int64_t y = slab.lo.y; y < slab.hi.y; ++y, rest = rest.subspan(row_voxels)) {
        planes.current.add_row(rest.first(row_voxels));
        row_read(planes, y, z);
      }
      if (slab.hi.y < shape.y) continue;
      plane_read(planes, z);
      std::swap(planes.current, planes.below);
      planes.current.clear();
    }
  });
}

inline void RunPlane::add_row(std::span<const RawLabel> labels) {
  for (std::size_t begin = 0, end = 0; begin < labels.size(); begin = end) {
    while (end < labels.size() && labels[end] == labels[begin]) ++end;
    runs_.push_back(
        {static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end), 0, labels[begin]});
  }
  row_begin_.push_back(runs_.size());
}

}  // namespace mw::io
