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
  std::string unit;            ///< behind numbers of the axis, "°"
  std::vector<double> shares;  ///< of each column; their sum is 1 or, with nothing to show, 0
};

/// A figure with title, columns that tell their range and share when pointed at, and an axis.
[[nodiscard]] std::string histogram_figure(const Histogram& histogram);

struct BarRow {
  std::string name;
  double value = 0;
  std::string text;  ///< the value, for people
};

/// A figure with one bar a row, the longest for the largest value.
[[nodiscard]] std::string bar_figure(const std::string& title, const std::vector<BarRow>& rows);

}  // namespace mw::cli
