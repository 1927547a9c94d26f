// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Blocks as they are kept: with the labels' own numbers in the place of their ranks.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/store/codec/block_codec.h"
#include "io/labels/label_table.h"

namespace mw::engine {

/// Numbers that ascend as labels do, whether signed or not.
class LabelKeys {
 public:
  /// The table outlives it.
  explicit LabelKeys(const io::LabelTable& table)
      : table_(table), flip_(table.is_signed() ? RawLabel{1} << 63U : 0) {}

  /// REQUIRES: a label of the table.
  [[nodiscard]] std::uint64_t key(Label label) const { return table_.raw(label) ^ flip_; }
  /// kExterior for a key of no label of the table.
  [[nodiscard]] Label label(std::uint64_t key) const { return table_.find(key ^ flip_); }
  [[nodiscard]] const io::LabelTable& table() const { return table_; }

 private:
  const io::LabelTable& table_;
  RawLabel flip_;
};

/// The bytes of encode_block() without its head and key, each label being its key: they are the
/// same when another label comes to the volume or leaves it.
///
///     labels var; each key var, minus the one before (ascending)
///     everything that follows the labels in encode_block()
///
/// REQUIRES: the bytes of encode_block(), with labels of the table.
[[nodiscard]] std::vector<std::byte> to_kept(std::span<const std::byte> encoded,
                                             const LabelKeys& labels);

/// The other way round.
/// ERRORS: DamagedWork when there is a label that the table does not have, or no list of labels.
[[nodiscard]] std::vector<std::byte> from_kept(const BlockKey& key, std::span<const std::byte> kept,
                                               const LabelKeys& labels);

}  // namespace mw::engine
