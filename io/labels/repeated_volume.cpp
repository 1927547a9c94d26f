// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Spreads each row of the volume below once and copies it to its other layers, and reads the copies
// of a cell part by part.
#include "io/labels/repeated_volume.h"

#include <algorithm>
#include <vector>

#include "kernels/core/assert.h"
#include "kernels/core/index.h"
#include "kernels/core/lattice.h"

namespace mw::io {
namespace {

/// Repeats the labels of a row from layer `lo` to layer `hi`; from is the voxel that holds `lo`.
void spread(const RawLabel* from, std::int64_t lo, std::int64_t hi, std::int64_t layers,
            RawLabel* to) {
  for (std::int64_t at = lo; at < hi; ++from) {
    const std::int64_t end = std::min((at / layers + 1) * layers, hi);
    to = std::fill_n(to, end - at, *from);
    at = end;
  }
}

/// Returns a / b rounded down.
std::int64_t quotient(std::int64_t a, std::int64_t b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// Returns the copies of a cell that a box meets; copy c begins at c * shape.
Box3 copies_over(const Box3& box, Index3 shape) {
  const Index3 last = box.hi - Index3{1, 1, 1};
  return {{quotient(box.lo.x, shape.x), quotient(box.lo.y, shape.y), quotient(box.lo.z, shape.z)},
          {quotient(last.x, shape.x) + 1, quotient(last.y, shape.y) + 1,
           quotient(last.z, shape.z) + 1}};
}

/// Reads the part of each copy of a cell that a box meets by read(box in the cell, values).
template <typename T, typename Read>
void read_copies(const Box3& box, Index3 cell, std::span<T> out, const Read& read) {
  std::vector<T> values;
  for_each_index(copies_over(box, cell), [&](Index3 copy) {
    const Index3 first{copy.x * cell.x, copy.y * cell.y, copy.z * cell.z};
    const Box3 part = intersection(box, {first, first + cell});
    values.resize(static_cast<std::size_t>(part.voxels()));
    read(Box3{part.lo - first, part.hi - first}, std::span<T>(values));
    std::size_t next = 0;
    for_each_index(
        part, [&](Index3 v) { out[static_cast<std::size_t>(box.offset(v))] = values[next++]; });
  });
}

}  // namespace

LayeredVolume::LayeredVolume(const LabelVolume& volume, Index3 layers)
    : VolumeView(volume), layers_(layers), info_(volume.info()) {
  info_.shape = layered_shape(info_.shape, layers);
  info_.space.spacing = layered_spacing(info_.space.spacing, layers);
  info_.chunk = layered_shape(info_.chunk, layers);
}

void LayeredVolume::read(const Box3& box, std::span<RawLabel> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  if (out.empty()) return;
  if (layers_ == Index3{1, 1, 1}) return below().read(box, out);
  const Box3 under = cells_of(box, layers_);
  std::vector<RawLabel> labels(static_cast<std::size_t>(under.voxels()));
  below().read(under, labels);
  const std::int64_t row = box.shape().x, plane = row * box.shape().y;
  RawLabel* to = out.data();
  for (std::int64_t z = box.lo.z; z < box.hi.z; ++z) {
    if (z > box.lo.z && z % layers_.z != 0) {
      to = std::copy_n(to - plane, plane, to);
      continue;
    }
    for (std::int64_t y = box.lo.y; y < box.hi.y; ++y, to += row) {
      if (y > box.lo.y && y % layers_.y != 0) {
        std::copy_n(to - row, row, to);
        continue;
      }
      const Index3 first{under.lo.x, y / layers_.y, z / layers_.z};
      spread(labels.data() + under.offset(first), box.lo.x, box.hi.x, layers_.x, to);
    }
  }
}

PeriodicVolume::PeriodicVolume(const LabelVolume& volume, Index3 margin)
    : VolumeView(volume), margin_(margin), info_(volume.info()) {
  info_.shape = info_.shape + margin + margin;
  const Vector3 first =
      to_world(info_.space, {-static_cast<double>(margin.x), -static_cast<double>(margin.y),
                             -static_cast<double>(margin.z)});
  info_.space.origin = first;
  if (const LabelScores* const scores = volume.scores()) {
    const Index3 cell = volume.info().shape, shape = scores->shape();
    scores_.emplace(*scores, Index3{margin.x * shape.x / cell.x, margin.y * shape.y / cell.y,
                                    margin.z * shape.z / cell.z});
  }
}

void PeriodicVolume::read(const Box3& box, std::span<RawLabel> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  if (out.empty()) return;
  read_copies({box.lo - margin_, box.hi - margin_}, below().info().shape, out,
              [this](const Box3& part, std::span<RawLabel> labels) { below().read(part, labels); });
}

void PeriodicVolume::PeriodicScores::read_scores(RawLabel label, const Box3& box,
                                                 std::span<double> out) const {
  read_copies(
      {box.lo - margin_, box.hi - margin_}, cell_.shape(), out,
      [&](const Box3& part, std::span<double> scores) { cell_.read_scores(label, part, scores); });
}

}  // namespace mw::io
