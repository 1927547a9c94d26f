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

/// Columns of equal width, two blanks between them; numbers to the right, names to the left.  A
/// column without any entry is left out.
void print_columns(const TextTable& table, std::ostream& out);

/// RFC 4180: fields with commas, quotes or line ends are quoted; lines end with '\n'.
void print_csv(const TextTable& table, std::ostream& out);

}  // namespace mw::cli
