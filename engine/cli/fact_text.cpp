// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facts, known as JSON, in lines of text.
#include "engine/cli/fact_text.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

namespace mw::cli {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kNameWidth = 13;

std::string plain_text(const ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string out;
  for (const ordered_json& element : value) out += (out.empty() ? "" : " ") + element.dump();
  return out;
}

}  // namespace

void print_row(std::string name, const ordered_json& row) {
  std::string out;
  for (const auto& [key, value] : row.items()) {
    out += (out.empty() ? "" : ", ") + key + " " + value.dump();
  }
  name.resize(std::max(name.size(), kNameWidth), ' ');
  std::cout << name << " " << out << "\n";
}

void print_facts(const ordered_json& facts, const std::string& prefix) {
  for (const auto& [key, value] : facts.items()) {
    std::string name = prefix + key;
    if (value.is_object()) {
      print_facts(value, name + ".");
      continue;
    }
    if (value.is_array() && !value.empty() && value.front().is_object()) {
      for (const ordered_json& row : value) print_row(name, row);
      continue;
    }
    name.resize(std::max(name.size(), kNameWidth), ' ');
    std::cout << name << " " << plain_text(value) << "\n";
  }
}

}  // namespace mw::cli
