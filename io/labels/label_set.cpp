// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sets of labels.
#include "io/labels/label_set.h"

#include <bit>

#include "io/labels/label_runs.h"

namespace mw::io {
namespace {

std::size_t first_slot(RawLabel label, std::size_t slots) {
  return static_cast<std::size_t>(spread_bits(label) >> (64 - std::countr_zero(slots)));
}

}  // namespace

void LabelSet::insert(std::span<const RawLabel> labels) {
  if (labels.empty()) return;
  RawLabel last = ~labels[0];
  for (const RawLabel label : labels) {
    if (label == last) continue;
    last = label;
    if (label < kSmallLabels) {
      small_[label] = 1;
    } else {
      insert_large(label);
    }
  }
}

void LabelSet::insert_large(RawLabel label) {
  std::size_t slot = first_slot(label, large_.size());
  while (large_[slot] != 0) {
    if (large_[slot] == label) return;
    slot = (slot + 1) & (large_.size() - 1);
  }
  large_[slot] = label;
  if (++large_count_ * 2 > large_.size()) grow();
}

void LabelSet::grow() {
  std::vector<RawLabel> old(large_.size() * 2);
  old.swap(large_);
  for (const RawLabel label : old) {
    if (label == 0) continue;
    std::size_t slot = first_slot(label, large_.size());
    while (large_[slot] != 0) slot = (slot + 1) & (large_.size() - 1);
    large_[slot] = label;
  }
}

std::vector<RawLabel> LabelSet::values() const {
  std::vector<RawLabel> out;
  for (std::size_t label = 0; label < kSmallLabels; ++label) {
    if (small_[label] != 0) out.push_back(label);
  }
  for (const RawLabel label : large_) {
    if (label != 0) out.push_back(label);
  }
  return out;
}

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
