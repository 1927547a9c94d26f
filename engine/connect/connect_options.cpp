// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rules of parts and interfaces from text.
#include "engine/connect/connect_options.h"

#include <algorithm>

#include "engine/settings/number_text.h"
#include "io/file/errors.h"

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
  if (!read_all(text, tets) || tets == 0) {
    fail_expected("all, largest, or the least number of tets of a part", text);
  }
  return {.least_tets = tets};
}

SplitRule parse_split(std::string_view text) {
  if (text == "*") return {.all = true, .pairs = {}};
  SplitRule out;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view pair = text.substr(begin, end - begin);
    const std::size_t bar = pair.find('|');
    if (bar == pair.npos) fail_expected("pairs of labels such as 1|2,1|3, or *", pair);
    const auto ends =
        std::minmax({parse_label(pair.substr(0, bar)), parse_label(pair.substr(bar + 1))});
    if (ends.first == ends.second) fail_expected("two labels", pair);
    out.pairs.emplace_back(ends);
    begin = end + 1;
  }
  std::sort(out.pairs.begin(), out.pairs.end());
  return out;
}

void check_split(const SplitRule& split, const io::LabelTable& table) {
  for (const auto& [low, high] : split.pairs) {
    for (const RawLabel label : {low, high}) {
      if (table.contains(label)) continue;
      throw Error(ErrorKind::kUsage,
                  io::text("--split: the volume has no label ", static_cast<std::int64_t>(label)));
    }
  }
}

}  // namespace mw::engine
