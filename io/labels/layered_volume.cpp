// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Spreads each row of the volume below once, and copies it to its other layers.
#include "io/labels/layered_volume.h"

#include <algorithm>
#include <vector>

#include "kernels/core/assert.h"
#include "kernels/core/index.h"
#include "kernels/core/layers.h"

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

}  // namespace mw::io
