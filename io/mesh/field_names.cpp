// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which array holds labels, and names of labels from three arrays of field data.
#include "io/mesh/field_names.h"

#include <algorithm>

#include "io/file/errors.h"

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

}  // namespace mw::io
