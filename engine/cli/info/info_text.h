// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh info` says, as text: facts, known as JSON, in lines; rows in columns, or as
// comma-separated values; and the tables of a mesh.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "engine/cli/info/mesh_info.h"
#include "io/json/json.h"

namespace mw::cli {

/// Prints a line for each fact, and for each object of a list, on stdout; facts of an object are
/// named "object.fact".
void print_facts(const io::Json& facts, const std::string& prefix = {});

/// Prints one line with the name and the row as "label 3, volume 12.5".
void print_row(std::string name, const io::Json& row);

/// The first row holds the titles; all rows have as many fields.
using TextTable = std::vector<std::vector<std::string>>;

/// Prints columns as wide as their widest field, two blanks apart, with numbers to the right and
/// names to the left.  A column that has nothing below its title is left out.
void print_columns(const TextTable& table, std::ostream& out);

/// Prints RFC 4180 with '\n' at line ends: fields with commas, quotes or line ends are quoted.
void print_csv(const TextTable& table, std::ostream& out);

/// How numbers of a table are written: with all digits for scripts, with four for people.
enum class Digits { kAll, kFour };

/// What a table of labels holds.
enum class LabelColumns { kSizes, kPlaces, kBoth };

/// Returns a table with a row for each label, ascending.
[[nodiscard]] TextTable label_table(const MeshInfo& facts, Digits digits, LabelColumns columns);

/// Returns a table with a row for each of contacts_of().
[[nodiscard]] TextTable contact_table(const MeshInfo& facts, Digits digits);

}  // namespace mw::cli
