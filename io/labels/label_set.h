// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A growing set of raw labels, made for long runs of few different ones, and the labels that a part
// of a volume has.
#pragma once

#include <span>
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

}  // namespace mw::io
