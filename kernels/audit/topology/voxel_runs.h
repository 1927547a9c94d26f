// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume as runs of equal labels along x, and the face-connected parts they make up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/audit/subject.h"
#include "kernels/core/disjoint_sets.h"

namespace mw::audit {

/// One row of voxels along x: where its runs begin (the first at 0) and their parts.
struct RunRow {
  std::span<const std::uint32_t> starts;
  std::span<const std::uint32_t> parts;
};

/// All runs of a volume.  The exterior is one more part, the last, of class label_count.
/// Memory: 8 bytes a run and 8 a row.
class VoxelRuns {
 public:
  /// REQUIRES and errors: as voxel_parts.
  VoxelRuns(const VoxelLabels& volume, std::size_t label_count);

  [[nodiscard]] Index3 shape() const { return shape_; }
  /// Ascending class of every part.
  [[nodiscard]] std::span<const Label> part_class() const { return part_class_; }
  [[nodiscard]] std::uint32_t exterior_part() const {
    return static_cast<std::uint32_t>(part_class_.size() - 1);
  }
  /// Runs of row (y, z); empty outside the box.
  [[nodiscard]] RunRow row(std::int64_t y, std::int64_t z) const;

 private:
  void find_runs(const VoxelLabels& volume, std::size_t label_count);
  void join_rows(std::size_t row, std::size_t other, const Label* labels, DisjointSets& sets) const;

  Index3 shape_;
  std::vector<std::uint64_t> row_begin_;
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> parts_;
  std::vector<Label> part_class_;
};

}  // namespace mw::audit
