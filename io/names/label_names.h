// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The names of labels, and the colours in which they are shown, also those that DICOM files have in
// CIELab (PS3.3, C.10.7.1.1).
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

/// The bytes of the longest name that is kept.
inline constexpr std::size_t kMaxNameBytes = 1000;

/// Returns a name that every output can hold.
/// ENSURES: valid UTF-8 of at most kMaxNameBytes, cut between two characters; without control
/// characters (a blank instead), without characters that XML does not allow (U+FFFD instead, as for
/// bytes that are no UTF-8), without blanks at its ends.  A clean name stays as it is.
[[nodiscard]] std::string clean_name(std::string_view bytes);

/// Whether the bytes are text in UTF-8 (RFC 3629).
[[nodiscard]] bool is_utf8(std::string_view bytes);

/// Returns in UTF-8 what the bytes are in Latin-1 (ISO 8859-1).
[[nodiscard]] std::string utf8_of_latin1(std::string_view bytes);

/// Red, green, blue and opacity, 0 to 255.
using Colour = std::array<std::uint8_t, 4>;

struct LabelName {
  RawLabel label = 0;
  std::string name;              ///< empty if it has none
  std::optional<Colour> colour;  ///< empty if unknown

  bool operator==(const LabelName&) const = default;
};

/// Names of labels, whether a volume has these labels or not.  Cheap to copy: copies share the
/// rows, which never change.
class LabelNames {
 public:
  LabelNames() = default;
  /// Cleans names (clean_name), and drops a colour of four zeros, which nobody sees.  The last of
  /// several rows of one label counts; a row without name and colour is left out.
  explicit LabelNames(std::vector<LabelName> rows);

  /// Returns the rows, ascending by label as unsigned numbers.
  [[nodiscard]] std::span<const LabelName> rows() const;
  [[nodiscard]] bool empty() const { return rows().empty(); }
  /// Returns the row of a label; null when nothing is known of it.
  [[nodiscard]] const LabelName* find(RawLabel label) const;
  /// Returns the name of a label; empty when there is none.
  [[nodiscard]] const std::string& name(RawLabel label) const;

  /// Returns the rows of both; where both name a label, or give its colour, the others win.
  [[nodiscard]] LabelNames merged_with(const LabelNames& others) const;
  /// Returns the rows of the labels for which wanted() is true.
  [[nodiscard]] LabelNames only(const std::function<bool(RawLabel)>& wanted) const;
  /// Returns the bytes of memory that the rows take.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  std::shared_ptr<const std::vector<LabelName>> rows_;  ///< null if there are none
};

/// CIE 1976 L*, a*, b* under the white D50, by which the profiles of ICC connect colours.
struct CieLab {
  double lightness = 0;  ///< 0 to 100
  double a = 0;          ///< green below 0, red above
  double b = 0;          ///< blue below 0, yellow above
};

/// Returns the colour whose lightness from 0 to 100, and a and b from -128 to 127, are each spread
/// over 16 bits.
[[nodiscard]] CieLab cielab_of(const std::array<std::uint16_t, 3>& spread);

/// Returns the opaque colour in sRGB, whose white is D65; white stays white (Bradford).  Each part
/// of a colour that screens cannot show becomes the nearest that they can.
[[nodiscard]] Colour srgb_of(const CieLab& lab);

}  // namespace mw::io
