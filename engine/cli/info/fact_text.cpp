// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facts, known as JSON, in lines of text.
#include "engine/cli/info/fact_text.h"

#include <algorithm>
#include <iostream>

#include "engine/cli/options/values.h"

namespace mw::cli {
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
