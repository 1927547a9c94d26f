// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facts, known as JSON, as text on stdout: in lines, in columns, or as comma-separated values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/json/json.h"

namespace mw::cli {

/// Prints a line for each fact, and for each object of a list; facts of an object are named
/// "object.fact".
void print_facts(const io::Json& facts, const std::string& prefix = {});

/// Prints one line with the name and the row as "label 3, volume 12.5".
void print_row(std::string name, const io::Json& row);

/// A fact of rows, as a column of a table; rows that do not have it leave its field empty.
struct Column {
  std::string title;
  std::string key = title;
  std::optional<std::size_t> at{};  ///< of the elements of a list
  std::string needs = key;          ///< the fact without which no row has the column
  double unit = 1;                  ///< in which numbers are given
};
using Columns = std::vector<Column>;

/// Prints columns as wide as their widest field, two blanks apart, with numbers to the right and
/// names to the left.  A column that has nothing below its title is left out.
void print_columns(const io::Json& rows, const Columns& columns);

/// Prints all digits in RFC 4180 with '\n' at line ends: fields with commas, quotes or line ends
/// are quoted.
void print_csv(const io::Json& rows, const Columns& columns);

}  // namespace mw::cli
