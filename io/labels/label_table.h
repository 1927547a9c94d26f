// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sets of raw labels, and a table that turns sparse 64-bit labels into dense ones and back.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/volume/label_volume.h"
#include "kernels/core/label.h"

namespace mw::io {

/// Small labels are flags in a table; others are in a hash set with linear probing.
class LabelSet {
 public:
  void insert(std::span<const RawLabel> labels);
  /// Returns the labels, in no particular order.
  [[nodiscard]] std::vector<RawLabel> values() const;

 private:
  void insert_large(RawLabel label);
  void grow();

  static constexpr std::size_t kSmallLabels = 1 << 16;
  std::vector<char> small_ = std::vector<char>(kSmallLabels);
  // Free slots hold 0, which is a small label.
  std::vector<RawLabel> large_ = std::vector<RawLabel>(1024);
  std::size_t large_count_ = 0;
};

/// Spreads the bits of a label over a table of 2^n slots: the slot is the top n bits.
[[nodiscard]] inline std::uint64_t spread_bits(RawLabel label) {
  std::uint64_t x = label * 0x9e3779b97f4a7c15U;
  x ^= x >> 32;
  return x * 0xd6e8feb86659fd93U;
}

/// Returns the labels of a box of the volume, in no particular order.  It reads the box once, in
/// the order of the file and in slabs of bounded memory.
[[nodiscard]] std::vector<RawLabel> labels_in(const LabelVolume& volume, const Box3& box);

/// Returns the number as users write it.
[[nodiscard]] inline std::string label_text(RawLabel label, bool is_signed) {
  return is_signed ? std::to_string(static_cast<std::int64_t>(label)) : std::to_string(label);
}

/// The labels of one volume in ascending order; the dense label is the rank.
class LabelTable {
 public:
  LabelTable() = default;
  /// Removes duplicates.  Signed labels are ordered as signed numbers.
  LabelTable(std::vector<RawLabel> labels, bool is_signed);

  [[nodiscard]] std::size_t size() const { return labels_.size(); }
  [[nodiscard]] bool is_signed() const { return is_signed_; }
  [[nodiscard]] RawLabel raw(Label dense) const { return labels_[dense]; }
  /// REQUIRES: raw is in the table.
  [[nodiscard]] Label dense(RawLabel raw) const { return slots_[slot(raw)]; }
  /// Returns the dense label of any number; kExterior for one that is not in the table.
  [[nodiscard]] Label find(RawLabel raw) const;
  [[nodiscard]] bool contains(RawLabel raw) const { return find(raw) != kExterior; }

 private:
  /// Where raw is or would be in slots_.
  [[nodiscard]] std::size_t slot(RawLabel raw) const;
  void fill_slots();

  std::vector<RawLabel> labels_;
  // The ranks of raw labels: a slot for each number from labels_[0] on when their range is small
  // (hashed_ false), else a hash table with linear probing.  Free slots hold kExterior.
  std::vector<Label> slots_;
  bool hashed_ = false;
  bool is_signed_ = false;
};

/// Returns the table of a volume's labels, by one pass over it in slabs of bounded memory.
[[nodiscard]] LabelTable collect_labels(const LabelVolume& volume);

/// Throws mw::Error(kInput), which says that the input is not what it was when its labels were
/// collected.
[[noreturn]] void fail_input_changed();

/// A volume seen through its table.  Thread safety: as LabelVolume.
class DenseVolume {
 public:
  DenseVolume(const LabelVolume& volume, const LabelTable& table)
      : volume_(&volume), table_(&table) {}

  [[nodiscard]] const LabelVolume& raw() const { return *volume_; }
  [[nodiscard]] const VolumeInfo& info() const { return volume_->info(); }
  [[nodiscard]] const LabelTable& table() const { return *table_; }
  /// Reads the voxels of a box as LabelVolume::read() does, as dense labels.
  /// ERRORS: fail_input_changed() for a label that is not in the table.
  void read(const Box3& box, std::span<Label> out) const;

 private:
  const LabelVolume* volume_;
  const LabelTable* table_;
};

}  // namespace mw::io
