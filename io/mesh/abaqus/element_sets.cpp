// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which set each tet of an Abaqus input file is in.
#include "io/mesh/abaqus/element_sets.h"

#include <algorithm>

#include "io/mesh/abaqus/inp_lines.h"

namespace mw::io {

std::uint64_t ElementSets::number_of(const std::string& name) {
  const auto [at, is_new] = numbers_.emplace(in_capitals(name), names_.size());
  if (is_new) names_.push_back(name);
  return at->second;
}

void ElementSets::close(std::span<RawLabel> marks) {
  if (open_.empty()) return;
  std::sort(open_.begin(), open_.end());
  const std::uint64_t none = number_of("");
  for (const Members& members : ranges_) mark_range(members, none, marks);
}

void ElementSets::mark_range(const Members& members, std::uint64_t none,
                             std::span<RawLabel> marks) const {
  const ElementRange& range = members.range;
  const auto begin = std::lower_bound(open_.begin(), open_.end(), Open{range.first, 0});
  for (auto at = begin; at != open_.end() && at->element <= range.last; ++at) {
    const bool in_step = (at->element - range.first) % range.step == 0;
    if (in_step && marks[at->tet] == none) marks[at->tet] = members.set;
  }
}

std::vector<std::string> ElementSets::keep_used(std::span<RawLabel> marks) const {
  std::vector<std::uint64_t> indices(names_.size(), 0);
  for (const RawLabel mark : marks) indices[mark] = 1;
  std::vector<std::string> used;
  for (std::size_t set = 0; set < names_.size(); ++set) {
    if (indices[set] == 0) continue;
    indices[set] = used.size();
    used.push_back(names_[set]);
  }
  for (RawLabel& mark : marks) mark = indices[mark];
  return used;
}

}  // namespace mw::io
