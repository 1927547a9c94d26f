// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How outputs say what labels are called.
#include "engine/report/name_facts.h"

#include "engine/report/figures.h"
#include "engine/report/mesh_facts.h"

namespace mw::report {

using io::Json;

std::string label_text(RawLabel label, bool is_signed, const io::LabelNames& names) {
  const std::string& name = names.name(label);
  return format_label(label, is_signed) + (name.empty() ? "" : " \"" + name + "\"");
}

audit::LabelText label_texts(const io::LabelTable& table, io::LabelNames names) {
  return [&table, names = std::move(names)](Label label) {
    return "label " + label_text(table.raw(label), table.is_signed(), names);
  };
}

Json named_row_json(RawLabel label, bool is_signed, const io::LabelNames& names) {
  Json row{{"label", label_json(label, is_signed)}};
  const std::string& name = names.name(label);
  if (!name.empty()) row["name"] = name;
  return row;
}

void add_colour(Json& row, RawLabel label, const io::LabelNames& names) {
  const io::LabelName* found = names.find(label);
  if (found != nullptr && found->colour) row["colour"] = *found->colour;
}

}  // namespace mw::report
