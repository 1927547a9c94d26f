// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Charts as SVG in a page; their colours are the style sheet's.
#pragma once

#include <string>
#include <vector>

namespace mw::cli {

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
