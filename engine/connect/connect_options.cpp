// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parses rules for parts and interfaces.
#include "engine/connect/connect_options.h"

#include <algorithm>

#include "engine/settings/number_text.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "kernels/core/sort_distinct.h"

namespace mw::engine {

bool SplitRule::cuts(RawLabel one, RawLabel other) const {
  if (one == other) return false;
  const std::pair<RawLabel, RawLabel> pair = std::minmax(one, other);
  return all || std::binary_search(pairs.begin(), pairs.end(), pair);
}

PartsRule parse_parts(std::string_view text) {
  if (text == "all") return {};
  if (text == "largest") return {.only_largest = true};
  std::uint64_t tets = 0;
  if (!read_number(text, tets) || tets == 0) {
    fail_expected("all, largest, or the least number of tets of a part", text);
  }
  return {.least_tets = tets};
}

namespace {

/// Returns the pairs of labels in the order of the text.
std::vector<std::array<RawLabel, 2>> parse_pairs(std::string_view text) {
  std::vector<std::array<RawLabel, 2>> out;
  for (const std::string_view pair : io::split_at(',', text)) {
    const std::size_t bar = pair.find('|');
    if (bar == pair.npos) fail_expected("pairs of labels such as 1|2,1|3, or *", pair);
    out.push_back({parse_label(pair.substr(0, bar)), parse_label(pair.substr(bar + 1))});
    if (out.back()[0] == out.back()[1]) fail_expected("two labels", pair);
  }
  return out;
}

void check_label(RawLabel label, const char* option, const io::LabelTable& table) {
  if (table.contains(label)) return;
  io::fail_usage(option, ": the volume has no label ", io::label_text(label, table.is_signed()));
}

}  // namespace

SplitRule ConnectOptions::all_split() const {
  SplitRule out = split;
  out.all = out.all || cohesive.all;
  for (const auto& [bottom, top] : cohesive.pairs) out.pairs.emplace_back(std::minmax(bottom, top));
  sort_distinct(out.pairs);
  return out;
}

SplitRule parse_split(std::string_view text) {
  if (text == "*") return {.all = true, .pairs = {}};
  SplitRule out;
  for (const auto& [one, other] : parse_pairs(text))
    out.pairs.emplace_back(std::minmax(one, other));
  std::sort(out.pairs.begin(), out.pairs.end());
  return out;
}

io::CohesiveRule parse_cohesive(std::string_view text) {
  if (text == "*") return {.all = true, .pairs = {}};
  io::CohesiveRule out;
  for (const auto& [bottom, top] : parse_pairs(text)) {
    if (out.has(bottom, top)) fail_expected("no pair of labels twice", text);
    out.pairs.push_back({bottom, top});
  }
  std::sort(out.pairs.begin(), out.pairs.end());
  return out;
}

void check_interfaces(const ConnectOptions& options, const io::LabelTable& table) {
  for (const auto& [low, high] : options.split.pairs) {
    check_label(low, "--split", table);
    check_label(high, "--split", table);
  }
  for (const auto& [bottom, top] : options.cohesive.pairs) {
    check_label(bottom, "--cohesive", table);
    check_label(top, "--cohesive", table);
  }
}

}  // namespace mw::engine
