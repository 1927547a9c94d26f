// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rows of text in columns, or as comma-separated values.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace mw::cli {

/// The first row holds the titles; all rows have as many fields.
using TextTable = std::vector<std::vector<std::string>>;

/// Prints columns as wide as their widest field, two blanks apart, with numbers to the right and
/// names to the left.  A column that has nothing below its title is left out.
void print_columns(const TextTable& table, std::ostream& out);

/// Prints RFC 4180 with '\n' at line ends: fields with commas, quotes or line ends are quoted.
void print_csv(const TextTable& table, std::ostream& out);

}  // namespace mw::cli
