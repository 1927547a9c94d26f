// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One group of pairs an interface.
#include "kernels/audit/cavities.h"

#include <algorithm>

namespace mw::audit {

Cavities cavities_of_interfaces(std::span<const Label> part_class,
                                const std::vector<PartPair>& face_pairs) {
  std::vector<JunctionLabels> groups;
  const auto group_of = [&](const PartPair& p) {
    const auto [a, b] = std::minmax(part_class[p.a], part_class[p.b]);
    return JunctionLabels{a, b, kNoLabel, kNoLabel};
  };
  for (const PartPair& p : face_pairs) groups.push_back(group_of(p));
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  std::vector<GroupedPair> pairs;
  for (const PartPair& p : face_pairs) {
    const auto found = std::lower_bound(groups.begin(), groups.end(), group_of(p));
    const auto group = static_cast<std::uint32_t>(found - groups.begin());
    pairs.push_back({p, group, group});
  }
  const auto components = components_leaving_out(part_class.size(), pairs, groups.size());
  Cavities out;
  for (std::size_t i = 0; i < groups.size(); ++i) out[groups[i]] = components[i] - 1;
  return out;
}

}  // namespace mw::audit
