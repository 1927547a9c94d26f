// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sets of labels, and sparse 64-bit labels to dense ones and back.
#include "io/labels/label_table.h"

#include <algorithm>
#include <bit>

#include "io/labels/label_runs.h"
#include "kernels/core/assert.h"
#include "kernels/core/error.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kDirectRange = 1 << 16;

std::size_t first_slot(RawLabel label, std::size_t slots) {
  return static_cast<std::size_t>(spread_bits(label) >> (64 - std::countr_zero(slots)));
}

}  // namespace

LabelTable::LabelTable(std::vector<RawLabel> labels, bool is_signed)
    : labels_(std::move(labels)), is_signed_(is_signed) {
  // With the top bit flipped, the order of unsigned numbers is that of signed ones.
  const RawLabel flip = is_signed ? RawLabel{1} << 63 : 0;
  std::sort(labels_.begin(), labels_.end(),
            [flip](RawLabel a, RawLabel b) { return (a ^ flip) < (b ^ flip); });
  labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
  if (labels_.size() >= kExterior) {
    throw Error(ErrorKind::kInput, "the volume has more different labels than 32 bits can number");
  }
  fill_slots();
}

void LabelTable::fill_slots() {
  if (labels_.empty()) return;
  // The difference wraps around correctly for signed labels too.
  const std::uint64_t range = labels_.back() - labels_.front();
  hashed_ = range >= kDirectRange;
  slots_.assign(hashed_ ? std::bit_ceil(labels_.size() * 2) : range + 1, kExterior);
  for (std::size_t rank = 0; rank < labels_.size(); ++rank) {
    slots_[slot(labels_[rank])] = static_cast<Label>(rank);
  }
}

std::size_t LabelTable::slot(RawLabel raw) const {
  if (!hashed_) return raw - labels_.front();
  const std::size_t mask = slots_.size() - 1;
  auto at = static_cast<std::size_t>(spread_bits(raw) >> (64 - std::popcount(mask)));
  while (slots_[at] != kExterior && labels_[slots_[at]] != raw) at = (at + 1) & mask;
  return at;
}

Label LabelTable::find(RawLabel raw) const {
  if (labels_.empty()) return kExterior;
  const std::size_t at = slot(raw);
  return at < slots_.size() ? slots_[at] : kExterior;
}

void fail_input_changed() {
  throw Error(ErrorKind::kInput,
              "the input changed while it was read: its labels are not those of the first reading; "
              "leave it as it is until the program has ended, and start again");
}

LabelTable collect_labels(const LabelVolume& volume) {
  const VolumeInfo& info = volume.info();
  return {labels_in(volume, {{0, 0, 0}, info.shape}), has_signed_labels(info)};
}

void DenseVolume::read(const Box3& box, std::span<Label> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  if (out.empty()) return;
  std::vector<RawLabel> buffer;
  Label* next = out.data();
  for_each_z_slab(box, kSlabVoxels, [&](const Box3& slab) {
    buffer.resize(static_cast<std::size_t>(slab.voxels()));
    volume_->read(slab, buffer);
    RawLabel last = ~buffer[0];
    Label dense = kExterior;
    for (const RawLabel raw : buffer) {
      if (raw != last) {
        last = raw;
        dense = table_->find(raw);
        if (dense == kExterior) fail_input_changed();
      }
      *next++ = dense;
    }
  });
}

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
