// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One pass in slabs.
#include "io/labels/labels_in.h"

#include "io/labels/label_set.h"
#include "io/labels/slabs.h"

namespace mw::io {
namespace {

/// 512 KiB of raw labels: stays in a second-level cache.
constexpr std::int64_t kSlabVoxels = 1 << 16;

}  // namespace

std::vector<RawLabel> labels_in(const LabelVolume& volume, const Box3& box) {
  if (box.voxels() == 0) return {};
  LabelSet set;
  std::vector<RawLabel> buffer;
  const auto visit = [&](const Box3& slab) {
    buffer.resize(static_cast<std::size_t>(slab.voxels()));
    volume.read(slab, buffer);
    set.insert(buffer);
  };
  if (volume.info().z_fastest) {
    for_each_x_slab(box, kSlabVoxels, visit);
  } else {
    for_each_z_slab(box, kSlabVoxels, visit);
  }
  return set.values();
}

}  // namespace mw::io
