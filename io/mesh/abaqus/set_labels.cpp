// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels of element sets, by their names.
#include "io/mesh/abaqus/set_labels.h"

#include <set>

#include "io/mesh/abaqus/inp_lines.h"
#include "io/names/name_fields.h"

namespace mw::io {
namespace {

/// What a name says.
struct Numbered {
  std::optional<RawLabel> label;
  bool negative = false;
  bool plain = false;  ///< nothing but the label
};

Numbered number_in(const std::string& name) {
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  const std::string number = name.substr(digits);
  const std::string before = in_capitals(name.substr(0, digits));
  if (number.empty()) return {};
  if (before == "LABEL_M") return {label_of("-" + number), true, true};
  return {label_of(number), false, before == "LABEL_"};
}

bool all_different(const std::vector<Numbered>& numbers) {
  std::set<RawLabel> seen;
  for (const Numbered& number : numbers) {
    if (!number.label || !seen.insert(*number.label).second) return false;
  }
  return true;
}

}  // namespace

SetLabels labels_of_sets(const std::vector<std::string>& sets) {
  std::vector<Numbered> numbers;
  for (const std::string& name : sets) numbers.push_back(number_in(name));
  const bool by_number = all_different(numbers);
  SetLabels out;
  std::vector<LabelName> names;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    out.labels.push_back(by_number ? *numbers[i].label : i + 1);
    out.labels_signed = out.labels_signed || (by_number && numbers[i].negative);
    if (by_number && numbers[i].plain) continue;
    names.push_back({.label = out.labels.back(), .name = sets[i], .colour = {}});
  }
  out.names = LabelNames(std::move(names));
  return out;
}

}  // namespace mw::io
