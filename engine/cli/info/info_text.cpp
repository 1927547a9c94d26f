// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facts as text, in lines and in columns.
#include "engine/cli/info/info_text.h"

#include <algorithm>
#include <iostream>

#include "engine/cli/requests.h"
#include "io/names/csv_names.h"

namespace mw::cli {
namespace {

using io::Json;
using Fields = std::vector<std::string>;

/// Writes a number, with all digits for scripts, with four for people.
using NumberText = std::string (*)(double);

std::string field_of(const Json& row, const Column& column, NumberText number_text) {
  const Json* value = row.find(column.key);
  if (value == nullptr) return "";
  if (column.at) value = &value->elements()[*column.at];
  if (value->is_float()) return number_text(value->number() / column.unit);
  return value->is_string() ? value->text() : value->dump();
}

/// Returns a row of titles, and one of fields for each row.
std::vector<Fields> fields_of(const Json& rows, Columns columns, NumberText number_text) {
  if (!rows.empty()) {
    std::erase_if(columns, [&](const Column& column) {
      return !rows.elements().front().contains(column.needs);
    });
  }
  std::vector<Fields> out(1);
  for (const Column& column : columns) out.front().push_back(column.title);
  for (const Json& row : rows.elements()) {
    out.emplace_back();
    for (const Column& column : columns) out.back().push_back(field_of(row, column, number_text));
  }
  return out;
}

bool is_number(const std::string& field) {
  return field.empty() || field.find_first_not_of("0123456789+-.e% ") == std::string::npos;
}

/// Returns the number of characters: bytes that continue one in UTF-8 do not count.
std::size_t width_of(const std::string& field) {
  return static_cast<std::size_t>(
      std::count_if(field.begin(), field.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

struct ColumnShape {
  std::size_t width = 0;
  bool numbers = true;
  bool empty = true;  ///< below the title
};

std::vector<ColumnShape> shapes_of(const std::vector<Fields>& table) {
  std::vector<ColumnShape> shapes(table.front().size());
  for (std::size_t row = 0; row < table.size(); ++row) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      shapes[i].width = std::max(shapes[i].width, width_of(table[row][i]));
      if (row == 0) continue;
      shapes[i].numbers = shapes[i].numbers && is_number(table[row][i]);
      shapes[i].empty = shapes[i].empty && table[row][i].empty();
    }
  }
  return shapes;
}

std::string csv_field(const std::string& field) {
  return field.find_first_of(",\"\r\n") == std::string::npos ? field : io::csv_quoted(field);
}

constexpr std::size_t kNameWidth = 13;

/// Returns a value as text within a row, where strings stay in quotes.
std::string text_of(const Json& value) {
  if (value.is_float()) return format_figure(value.number());
  if (!value.is_array()) return value.dump();
  std::string out;
  for (const Json& element : value.elements()) out += (out.empty() ? "" : ",") + text_of(element);
  return "[" + out + "]";
}

std::string plain_text(const Json& value) {
  if (value.is_string()) return value.text();
  if (!value.is_array()) return text_of(value);
  std::string out;
  for (const Json& element : value.elements()) out += (out.empty() ? "" : " ") + text_of(element);
  return out;
}

}  // namespace

void print_columns(const Json& rows, const Columns& columns) {
  const std::vector<Fields> table = fields_of(rows, columns, format_figure);
  const std::vector<ColumnShape> shapes = shapes_of(table);
  for (const Fields& row : table) {
    std::string line;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (shapes[i].empty) continue;
      const std::string blanks(shapes[i].width - width_of(row[i]), ' ');
      line += (i > 0 ? "  " : "") + (shapes[i].numbers ? blanks + row[i] : row[i] + blanks);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    std::cout << line << '\n';
  }
}

void print_csv(const Json& rows, const Columns& columns) {
  for (const Fields& row : fields_of(rows, columns, format_number)) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += (i > 0 ? "," : "") + csv_field(row[i]);
    std::cout << line << '\n';
  }
}

void print_row(std::string name, const Json& row) {
  std::string out;
  for (const auto& [key, value] : row.items()) {
    out += (out.empty() ? "" : ", ") + key + " " + text_of(value);
  }
  name.resize(std::max(name.size(), kNameWidth), ' ');
  std::cout << name << " " << out << "\n";
}

void print_facts(const Json& facts, const std::string& prefix) {
  for (const auto& [key, value] : facts.items()) {
    std::string name = prefix + key;
    if (value.is_object()) {
      print_facts(value, name + ".");
      continue;
    }
    if (value.is_array() && !value.empty() && value.elements().front().is_object()) {
      for (const Json& row : value.elements()) print_row(name, row);
      continue;
    }
    name.resize(std::max(name.size(), kNameWidth), ' ');
    std::cout << name << " " << plain_text(value) << "\n";
  }
}

}  // namespace mw::cli
