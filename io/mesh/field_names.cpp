// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which array holds labels, names of labels from three arrays of field data, and names of values.
#include "io/mesh/field_names.h"

#include <algorithm>
#include <set>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::io {
namespace {

std::optional<Colour> colour_of(const FieldNames& fields, std::size_t row) {
  if (fields.colours.empty()) return std::nullopt;
  Colour colour{};
  for (std::size_t i = 0; i < 4; ++i) {
    colour[i] = static_cast<std::uint8_t>(fields.colours[4 * row + i]);
  }
  if (colour == Colour{}) return std::nullopt;
  return colour;
}

constexpr std::size_t kMostLetters = 31;

std::string value_name(const std::string& array) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::string out;
  for (const char c : array) out += is_letter(c) || (c >= '0' && c <= '9') ? c : '_';
  if (out.empty() || !is_letter(out.front())) out = "value_" + out;
  return out.substr(0, kMostLetters);
}

}  // namespace

const std::string* choose_label(const std::vector<std::string>& names) {
  for (const char* known : {"label", "Label", "labels", "material", "medit:ref"}) {
    const auto found = std::find(names.begin(), names.end(), known);
    if (found != names.end()) return &*found;
  }
  return names.size() == 1 ? &names.front() : nullptr;
}

LabelNames names_of(const FieldNames& fields, std::string_view file) {
  const std::size_t count = fields.ids.size();
  const bool fits = fields.colours.empty() || fields.colours.size() == 4 * count;
  if (fields.names.size() != count || !fits) {
    fail_input(file, "field data of labels",
               text(count, " numbers, ", fields.names.size(), " names and ",
                    fields.colours.size() / 4, " colours do not belong together"),
               "the file is damaged");
  }
  std::vector<LabelName> rows;
  for (std::size_t i = 0; i < count; ++i) {
    rows.push_back({fields.ids[i], fields.names[i], colour_of(fields, i)});
  }
  return LabelNames(std::move(rows));
}

std::vector<std::string> value_names(const std::vector<std::string>& arrays) {
  std::set<std::string> taken{"label"};
  std::vector<std::string> out;
  for (const std::string& array : arrays) {
    const std::string wanted = value_name(array);
    std::string name = wanted;
    for (int i = 2; !taken.insert(lower_case(name)).second; ++i) {
      const std::string behind = text("_", i);
      name = wanted.substr(0, kMostLetters - behind.size()) + behind;
    }
    out.push_back(name);
  }
  return out;
}

void name_values(std::vector<TetValues>& values) {
  std::vector<std::string> arrays;
  for (const TetValues& column : values) arrays.push_back(column.name);
  const std::vector<std::string> names = value_names(arrays);
  for (std::size_t i = 0; i < values.size(); ++i) values[i].name = names[i];
}

}  // namespace mw::io
