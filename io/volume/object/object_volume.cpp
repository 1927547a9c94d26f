// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a volume that shows one object, cell by cell.
#include "io/volume/object/object_volume.h"

#include <algorithm>

namespace mw::io {

ObjectVolume::ObjectVolume(std::unique_ptr<LabelVolume> volume, ObjectLabels labels,
                           ObjectCells cells)
    : VolumeView(std::move(volume)), labels_(std::move(labels)), cells_(std::move(cells)) {}

void ObjectVolume::read(const Box3& box, std::span<RawLabel> out) const {
  std::fill(out.begin(), out.end(), kNotTheObject);
  std::vector<RawLabel> voxels;
  for_each_index(cells_.met_by(box), [&](Index3 cell) {
    if (!cells_.has(cell)) return;
    const Box3 part = intersection(cells_.voxels(cell), box);
    voxels.resize(static_cast<std::size_t>(part.voxels()));
    below().read(part, voxels);
    std::size_t at = 0;
    for_each_index(part, [&](Index3 v) {
      const RawLabel label = voxels[at++];
      if (!std::binary_search(labels_.begin(), labels_.end(), label)) return;
      out[static_cast<std::size_t>(box.offset(v))] = label;
    });
  });
}

}  // namespace mw::io
