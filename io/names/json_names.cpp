// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads names of labels from JSON.
#include "io/names/json_names.h"

#include <map>
#include <optional>
#include <vector>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/json/json.h"
#include "io/names/colour_table.h"

namespace mw::io {
namespace {

/// Returns the label of a number, of a list of one number, or of digits.
std::optional<RawLabel> label_in(const Json& value) {
  if (value.is_integer()) return value.integer();
  if (value.is_string()) return label_of(value.text());
  if (value.is_array() && value.elements().size() == 1) return label_in(value.elements().front());
  return std::nullopt;
}

/// Returns the name of "1": "liver" or "liver": 1; nothing for a field of another kind.
std::optional<LabelName> name_in(const Json::Field& field) {
  const auto key = label_of(field.key);
  if (key && field.value.is_string()) {
    return LabelName{.label = *key, .name = field.value.text(), .colour = {}};
  }
  const auto label = label_in(field.value);
  if (!label) return std::nullopt;
  return LabelName{.label = *label, .name = field.key, .colour = {}};
}

std::vector<LabelName> names_in(const Json& object) {
  std::vector<LabelName> out;
  for (const Json::Field& field : object.items()) {
    if (auto name = name_in(field)) out.push_back(std::move(*name));
  }
  return out;
}

[[noreturn]] void fail_twice(std::string_view file, const std::string& one,
                             const std::string& other) {
  fail_input(file, {},
             text("'", printable(one, 60), "' and '", printable(other, 60),
                  "' are one label, or have one name"),
             "name each label once");
}

void check_once(const std::vector<LabelName>& names, std::string_view file) {
  std::map<RawLabel, const std::string*> labels;
  std::map<std::string_view, RawLabel> texts;
  for (const LabelName& name : names) {
    const auto [at, is_new] = labels.emplace(name.label, &name.name);
    if (!is_new) fail_twice(file, *at->second, name.name);
    if (name.name.empty()) continue;
    if (!texts.emplace(name.name, name.label).second) fail_twice(file, name.name, name.name);
  }
}

/// Returns the names of the only object in a document that has some.
std::vector<LabelName> names_of_parts(const Json& document, std::string_view file) {
  std::vector<LabelName> out;
  std::string found;
  for (const Json::Field& part : document.items()) {
    if (!part.value.is_object()) continue;
    std::vector<LabelName> names = names_in(part.value);
    if (names.empty()) continue;
    if (!out.empty()) {
      fail_input(file, {},
                 text("names labels in '", printable(found, 60), "' and in '",
                      printable(part.key, 60), "'"),
                 "save the one that is meant, as in Python json.dump(class_map['total'], file)");
    }
    out = std::move(names);
    found = part.key;
  }
  return out;
}

}  // namespace

bool is_json_object(std::string_view text) {
  return trimmed(text).starts_with('{');
}

LabelNames parse_json_names(std::string_view text, std::string_view file) {
  const Json document = parse_json(text, file);
  const Json* labels = document.find("labels");
  const bool has_labels = labels != nullptr && labels->is_object();
  std::vector<LabelName> names = names_in(has_labels ? *labels : document);
  if (names.empty() && !has_labels) names = names_of_parts(document, file);
  check_once(names, file);
  return LabelNames(std::move(names));
}

}  // namespace mw::io
