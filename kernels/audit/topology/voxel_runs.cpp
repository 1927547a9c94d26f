// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Runs of equal labels along x and their union into face-connected parts.
#include "kernels/audit/topology/voxel_runs.h"

#include <algorithm>
#include <limits>
#include <string>

#include "kernels/audit/topology/part_graph.h"
#include "kernels/core/error.h"

namespace mw::audit {
namespace {

constexpr std::size_t kMaxRuns = std::numeric_limits<std::uint32_t>::max() - std::size_t{1};

void require_sound(const VoxelLabels& volume) {
  const Index3 s = volume.shape;
  if (s.x < 1 || s.y < 1 || s.z < 1) {
    throw Error(ErrorKind::kInput, "audit: the volume has no voxels");
  }
  if (volume.labels.size() != static_cast<std::size_t>(s.product())) {
    throw Error(ErrorKind::kInput, "audit: the volume has " + std::to_string(s.product()) +
                                       " voxels but " + std::to_string(volume.labels.size()) +
                                       " labels");
  }
}

}  // namespace

VoxelRuns::VoxelRuns(const VoxelLabels& volume, std::size_t label_count) : shape_(volume.shape) {
  require_sound(volume);
  find_runs(volume, label_count);
  const auto nx = static_cast<std::size_t>(shape_.x);
  const auto ny = static_cast<std::size_t>(shape_.y);
  DisjointSets sets(starts_.size());
  for (std::size_t row = 0; row + 1 < row_begin_.size(); ++row) {
    if (row % ny != 0) join_rows(row, row - 1, volume.labels.data(), sets);
    if (row >= ny) join_rows(row, row - ny, volume.labels.data(), sets);
  }
  const auto class_of_run = [&](std::size_t run) {
    const auto after = std::upper_bound(row_begin_.begin(), row_begin_.end(), run);
    const auto row = static_cast<std::size_t>(after - row_begin_.begin()) - 1;
    return volume.labels[row * nx + starts_[run]];
  };
  Parts parts = number_parts(std::move(sets), label_count, class_of_run);
  parts_ = std::move(parts.of_member);
  part_class_ = std::move(parts.part_class);
  part_class_.push_back(static_cast<Label>(label_count));
}

void VoxelRuns::find_runs(const VoxelLabels& volume, std::size_t label_count) {
  const auto nx = static_cast<std::size_t>(shape_.x);
  const auto rows = static_cast<std::size_t>(shape_.y * shape_.z);
  row_begin_.reserve(rows + 1);
  row_begin_.push_back(0);
  for (std::size_t row = 0; row < rows; ++row) {
    const Label* labels = volume.labels.data() + row * nx;
    for (std::size_t x = 0; x < nx; ++x) {
      if (x > 0 && labels[x] == labels[x - 1]) continue;
      if (labels[x] >= label_count) {
        throw Error(ErrorKind::kInput, "audit: voxel " + std::to_string(row * nx + x) +
                                           " has a label outside the label table");
      }
      starts_.push_back(static_cast<std::uint32_t>(x));
    }
    if (starts_.size() > kMaxRuns) {
      throw Error(ErrorKind::kResource, "audit: more than 2^32 runs of equal labels; audit parts");
    }
    row_begin_.push_back(starts_.size());
  }
}

void VoxelRuns::join_rows(std::size_t row, std::size_t other, const Label* labels,
                          DisjointSets& sets) const {
  const auto nx = static_cast<std::size_t>(shape_.x);
  std::uint64_t a = row_begin_[row];
  std::uint64_t b = row_begin_[other];
  const auto end_of = [&](std::uint64_t run, std::size_t in_row) {
    return run + 1 < row_begin_[in_row + 1] ? std::size_t{starts_[run + 1]} : nx;
  };
  while (a < row_begin_[row + 1] && b < row_begin_[other + 1]) {
    if (labels[row * nx + starts_[a]] == labels[other * nx + starts_[b]]) {
      sets.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    }
    const std::size_t a_end = end_of(a, row);
    const std::size_t b_end = end_of(b, other);
    if (a_end <= b_end) ++a;
    if (b_end <= a_end) ++b;
  }
}

RunRow VoxelRuns::row(std::int64_t y, std::int64_t z) const {
  if (y < 0 || y >= shape_.y || z < 0 || z >= shape_.z) return {};
  const auto row = static_cast<std::size_t>(z * shape_.y + y);
  const std::size_t begin = row_begin_[row];
  const std::size_t count = row_begin_[row + 1] - begin;
  return {std::span(starts_).subspan(begin, count), std::span(parts_).subspan(begin, count)};
}

}  // namespace mw::audit
