// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels in a table of separated values.
#pragma once

#include <string_view>

#include "io/names/label_names.h"

namespace mw::io {

/// The separator is the first of tab, semicolon and comma that the first row has.  A first row that
/// does not begin with a number says what the columns are, in any case and order:
///   the label   id, index, value, label value or label;
///   its name    name, region, structure, label name, or label beside an id;
///   its colour  r, g, b (red, ...; a or alpha) from 0 to 255, or from 0 to 1 where there is a
///               point in the number, or color, colour, hex: #rrggbb or #rrggbbaa.
/// Other columns are ignored.  Without such a row the first column is the label, the second its
/// name.
/// ERRORS: mw::Error(kInput) naming file and line.
[[nodiscard]] LabelNames parse_csv_names(std::string_view text, std::string_view file);

/// Whether the line has one of the separators.
[[nodiscard]] bool is_csv_line(std::string_view line);

}  // namespace mw::io
