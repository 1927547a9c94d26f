// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pieces of text in the form that HTML, and JSON in HTML, need; and charts as SVG, whose colours
// are the style sheet's.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/json/json.h"

namespace mw::cli {

/// Escapes a string for text and for attributes in double quotes.
[[nodiscard]] std::string escaped(std::string_view text);

/// Returns JSON that may stand in a script element, whatever its strings hold.
[[nodiscard]] std::string script_json(const io::Json& value);

using AppendText = std::function<void(std::string_view)>;

/// Encodes bytes in base64 and passes them on as they come.  Memory: 4 KiB.
class Base64 {
 public:
  explicit Base64(AppendText append) : append_(std::move(append)) {}

  void add(std::span<const std::byte> bytes);
  /// Passes on the rest; called once, at the end.
  void finish();

 private:
  void encode(std::size_t count);

  AppendText append_;
  std::string text_;
  std::uint32_t bits_ = 0;
  std::size_t held_ = 0;  ///< bytes in bits_
};

/// Columns of equal width from one end of an axis to the other.
struct Histogram {
  std::string title;
  std::string note;            ///< a line below the title
  double from = 0, to = 1;     ///< ends of the axis
  std::string unit;            ///< stands behind numbers of the axis, "°"
  std::vector<double> shares;  ///< one for each column; they sum to 1 or, with nothing to show, 0
};

/// Returns a figure with title, axis, and columns that tell range and share when pointed at.
[[nodiscard]] std::string histogram_figure(const Histogram& histogram);

struct BarRow {
  std::string name;
  double value = 0;
  std::string text;  ///< the value, for people
};

/// Returns a figure with one bar for each row; the longest is that of the largest value.
[[nodiscard]] std::string bar_figure(const std::string& title, const std::vector<BarRow>& rows);

}  // namespace mw::cli
