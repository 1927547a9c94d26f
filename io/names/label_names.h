// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What labels are called, and the colours they are shown in.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/core/label.h"

namespace mw::io {

/// Longest name that is kept, bytes.
inline constexpr std::size_t kMaxNameBytes = 1000;

/// ENSURES: valid UTF-8 of at most kMaxNameBytes, cut between two characters; without control
/// characters (a blank instead), without characters that XML does not allow (U+FFFD instead, as for
/// bytes that are no UTF-8), without blanks at its ends.  A clean name stays as it is.
[[nodiscard]] std::string clean_name(std::string_view bytes);

/// Red, green, blue and opacity, 0 to 255.
using Colour = std::array<std::uint8_t, 4>;

struct LabelName {
  RawLabel label = 0;
  std::string name;              ///< empty: it has none
  std::optional<Colour> colour;  ///< empty: unknown

  bool operator==(const LabelName&) const = default;
};

/// Names of labels, whether a volume has these labels or not.  Cheap to copy: copies share the
/// rows, which never change.
class LabelNames {
 public:
  LabelNames() = default;
  /// Names are cleaned (clean_name), and a colour of four zeros, which nobody sees, is none.  Of
  /// several rows of one label the last counts; one without name and colour is left out.
  explicit LabelNames(std::vector<LabelName> rows);

  /// Ascending by label, as unsigned numbers.
  [[nodiscard]] std::span<const LabelName> rows() const;
  [[nodiscard]] bool empty() const { return rows().empty(); }
  /// Null when nothing is known of the label.
  [[nodiscard]] const LabelName* find(RawLabel label) const;
  /// Empty when there is none.
  [[nodiscard]] const std::string& name(RawLabel label) const;

  /// The rows of both; where both name a label, or give its colour, the others win.
  [[nodiscard]] LabelNames merged_with(const LabelNames& others) const;
  /// The rows of these labels.
  [[nodiscard]] LabelNames only(const std::function<bool(RawLabel)>& wanted) const;
  /// What the rows take in memory.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  std::shared_ptr<const std::vector<LabelName>> rows_;  ///< null: none
};

}  // namespace mw::io
