// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Blocks as they are kept: with the labels' own numbers instead of their ranks.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/store/codec/block_codec.h"
#include "io/labels/label_table.h"

namespace mw::engine {

/// Keys of labels: numbers that ascend as the labels' own numbers do, whether signed or not.
class LabelKeys {
 public:
  /// The table outlives it.
  explicit LabelKeys(const io::LabelTable& table)
      : table_(table), flip_(table.is_signed() ? RawLabel{1} << 63U : 0) {}

  /// REQUIRES: a label of the table.
  [[nodiscard]] std::uint64_t key(Label label) const { return table_.raw(label) ^ flip_; }
  /// Returns kExterior for a key of no label of the table.
  [[nodiscard]] Label label(std::uint64_t key) const { return table_.find(key ^ flip_); }

 private:
  const io::LabelTable& table_;
  RawLabel flip_;
};

/// Returns the bytes of encode_block() without head and block key, and with each label's key in its
/// place: they stay the same when another label comes to the volume or leaves it.
///
///     labels var; each key var, minus the one before (ascending)
///     everything that follows the labels in encode_block()
///
/// REQUIRES: the bytes of encode_block(), with labels of the table.
[[nodiscard]] std::vector<std::byte> to_kept(std::span<const std::byte> encoded,
                                             const LabelKeys& labels);

/// Returns the bytes of encode_block() for a block that to_kept() made.
/// ERRORS: DamagedWork when it has a label that the table does not have, or no list of labels.
[[nodiscard]] std::vector<std::byte> from_kept(const BlockKey& key, std::span<const std::byte> kept,
                                               const LabelKeys& labels);

}  // namespace mw::engine
