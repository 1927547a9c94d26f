// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/output/line_share.h"

namespace mw::engine {

std::vector<std::uint32_t> line_owners(const RunLayout& layout, const Partition& partition) {
  const BlockRoute route(layout);
  const std::uint32_t last = layout.marches() - 1;
  const Index3 blocks = layout.grid(last).blocks();
  std::vector<std::uint32_t> out;
  for_each_index(Index3{1, blocks.y, blocks.z}, [&](Index3 line) {
    const WindowKey visitor = route.last_version({last, line}).from;
    out.push_back(static_cast<std::uint32_t>(partition.rank_of(visitor)));
  });
  return out;
}

}  // namespace mw::engine
