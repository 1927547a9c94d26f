// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A bit for each label of a window, so that sets of labels are words.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/core/label.h"

namespace mw {

/// The labels of a mesh in ascending order have the bits 0 to 63, and then 0 again.  So the bits
/// follow from the order of these labels alone: a label that is elsewhere in the volume, and shifts
/// the numbers of the others, changes nothing here.
/// Memory: at most 64 bytes a label.
class LabelBits {
 public:
  LabelBits() : LabelBits(std::vector<Label>{}) {}
  /// REQUIRES: ascending, each label once.
  explicit LabelBits(const std::vector<Label>& labels)
      : slots_(std::bit_ceil(std::max<std::size_t>(4 * labels.size(), 4))),
        shift_(static_cast<unsigned>(32 - std::countr_zero(slots_.size()))) {
    unsigned next = 0;
    for (const Label label : labels) {
      std::size_t at = slot(label);
      while (slots_[at].bit != kFree) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = {label, static_cast<std::uint8_t>(next++ % 64)};
    }
  }

  /// The label's bit; 0 for a label that is not one of these.
  [[nodiscard]] std::uint64_t of(Label label) const {
    for (std::size_t at = slot(label);; at = (at + 1) & (slots_.size() - 1)) {
      if (slots_[at].bit == kFree) return 0;
      if (slots_[at].label == label) return std::uint64_t{1} << slots_[at].bit;
    }
  }

 private:
  static constexpr std::uint8_t kFree = 0xff;
  struct Slot {
    Label label = 0;
    std::uint8_t bit = kFree;
  };

  [[nodiscard]] std::size_t slot(Label label) const { return label * 0x9E3779B1U >> shift_; }

  std::vector<Slot> slots_;  ///< a hash table with linear probing, for look-ups only
  unsigned shift_;
};

}  // namespace mw
