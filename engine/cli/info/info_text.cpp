// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facts in lines of text, and tables of a mesh.
#include "engine/cli/info/info_text.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <ostream>

#include "engine/cli/options/values.h"
#include "io/names/csv_names.h"

namespace mw::cli {
namespace {

std::string number(Digits digits, double value) {
  if (digits == Digits::kAll) return format_number(value);
  return format_figure(value);
}

using Fields = std::vector<std::string>;

void add_fields(Fields& row, std::initializer_list<std::string> fields) {
  row.insert(row.end(), fields);
}

void add_position(Fields& row, const io::Position& p, Digits digits) {
  for (const double x : p) row.push_back(number(digits, x));
}

/// Returns whether a table for people has millilitres: the volume tells that lengths are in mm.
bool shows_millilitres(const MeshInfo& facts, Digits digits) {
  return digits == Digits::kFour && facts.volume && facts.volume->unit == "mm";
}

Fields label_titles(const MeshInfo& facts, Digits digits) {
  Fields titles{"label", "name", shows_millilitres(facts, digits) ? "mm3" : "volume"};
  if (shows_millilitres(facts, digits)) titles.push_back("mL");
  if (facts.volume) add_fields(titles, {"voxels", "volume_error"});
  add_fields(titles, {"area", "area_on_box", "tets"});
  if (facts.mesh.labels.empty() || facts.mesh.labels.front().betti) {
    add_fields(titles, {"components", "b0", "b1", "b2"});
  }
  add_fields(titles, {"rr_min", "rr_mean"});
  return titles;
}

Fields label_fields(const MeshInfo& facts, Label rank, Digits digits) {
  const LabelStats& label = facts.mesh.labels[rank];
  const RawLabel raw = facts.table.raw(rank);
  Fields row{io::label_text(raw, facts.table.is_signed()), facts.names.name(raw),
             number(digits, label.volume)};
  if (shows_millilitres(facts, digits)) row.push_back(number(digits, label.volume / 1000));
  if (facts.volume) {
    const auto voxels = voxels_of(facts, rank);
    row.push_back(voxels ? std::to_string(voxels->voxels) : "0");
    row.push_back(voxels ? number(digits, voxels->error) : "");
  }
  add_fields(row, {number(digits, label.area), number(digits, label.area_on_box),
                   std::to_string(label.tets)});
  if (label.betti) {
    add_fields(row,
               {std::to_string(label.betti->open.b0), std::to_string(label.betti->closed.b0),
                std::to_string(label.betti->closed.b1), std::to_string(label.betti->closed.b2)});
  }
  add_fields(row,
             {number(digits, label.radius_ratio_min), number(digits, label.radius_ratio_mean)});
  return row;
}

constexpr std::array kJunctionTitles{"lo_x", "lo_y",       "lo_z",       "hi_x",      "hi_y",
                                     "hi_z", "centroid_x", "centroid_y", "centroid_z"};

Fields place_fields(const LabelStats& label, Digits digits) {
  Fields row;
  for (const io::Position& p : {label.lo, label.hi, label.centroid}) add_position(row, p, digits);
  return row;
}

Fields titles_of(const MeshInfo& facts, Digits digits, LabelColumns columns) {
  Fields titles = columns == LabelColumns::kPlaces ? Fields{"label"} : label_titles(facts, digits);
  if (columns == LabelColumns::kSizes) return titles;
  titles.insert(titles.end(), kJunctionTitles.begin(), kJunctionTitles.end());
  return titles;
}

Fields fields_of(const MeshInfo& facts, Label rank, Digits digits, LabelColumns columns) {
  Fields row = label_fields(facts, rank, digits);
  if (columns == LabelColumns::kSizes) return row;
  if (columns == LabelColumns::kPlaces) row.resize(1);
  const Fields position = place_fields(facts.mesh.labels[rank], digits);
  row.insert(row.end(), position.begin(), position.end());
  return row;
}

}  // namespace

TextTable label_table(const MeshInfo& facts, Digits digits, LabelColumns columns) {
  TextTable table{titles_of(facts, digits, columns)};
  for (Label rank = 0; rank < facts.table.size(); ++rank) {
    table.push_back(fields_of(facts, rank, digits, columns));
  }
  return table;
}

TextTable contact_table(const MeshInfo& facts, Digits digits) {
  Fields titles{"first", "second", "triangles", "area"};
  if (facts.volume) titles.emplace_back("voxel_area");
  TextTable table{titles};
  for (const Contact& c : contacts_of(facts)) {
    const bool is_signed = facts.table.is_signed();
    Fields row{io::label_text(c.first, is_signed), io::label_text(c.second, is_signed),
               std::to_string(c.triangles), number(digits, c.area)};
    if (c.voxel_area) row.push_back(number(digits, *c.voxel_area));
    table.push_back(row);
  }
  return table;
}

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

namespace {

using io::Json;

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
