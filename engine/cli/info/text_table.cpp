// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rows of text in columns, or as comma-separated values.
#include "engine/cli/info/text_table.h"

#include <algorithm>
#include <ostream>

#include "io/names/csv_names.h"

namespace mw::cli {
namespace {

bool is_number(const std::string& field) {
  return field.empty() || field.find_first_not_of("0123456789+-.e% ") == std::string::npos;
}

/// Returns the number of characters: bytes that continue one in UTF-8 do not count.
std::size_t width_of(const std::string& field) {
  return static_cast<std::size_t>(
      std::count_if(field.begin(), field.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

struct Column {
  std::size_t width = 0;
  bool numbers = true;
  bool empty = true;  ///< below the title
};

std::vector<Column> columns_of(const TextTable& table) {
  std::vector<Column> columns(table.front().size());
  for (std::size_t row = 0; row < table.size(); ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      columns[i].width = std::max(columns[i].width, width_of(table[row][i]));
      if (row == 0) continue;
      columns[i].numbers = columns[i].numbers && is_number(table[row][i]);
      columns[i].empty = columns[i].empty && table[row][i].empty();
    }
  }
  return columns;
}

std::string csv_field(const std::string& field) {
  return field.find_first_of(",\"\r\n") == std::string::npos ? field : io::csv_quoted(field);
}

}  // namespace

void print_columns(const TextTable& table, std::ostream& out) {
  const std::vector<Column> columns = columns_of(table);
  for (const std::vector<std::string>& row : table) {
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].empty) continue;
      const std::string blanks(columns[i].width - width_of(row[i]), ' ');
      line += (i > 0 ? "  " : "") + (columns[i].numbers ? blanks + row[i] : row[i] + blanks);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out << line << '\n';
  }
}

void print_csv(const TextTable& table, std::ostream& out) {
  for (const std::vector<std::string>& row : table) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += (i > 0 ? "," : "") + csv_field(row[i]);
    out << line << '\n';
  }
}

}  // namespace mw::cli
