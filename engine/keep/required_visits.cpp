// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Walks forwards to the windows that an edit may reach, then backwards to what these need.
#include "engine/keep/required_visits.h"

#include <algorithm>

#include "engine/store/block_route.h"

namespace mw::engine {
namespace {

/// Returns the windows of all marches in the order of the run.
std::vector<WindowKey> in_order(const RunLayout& layout) {
  std::vector<WindowKey> out;
  for (std::uint32_t march = 0; march < layout.marches(); ++march) {
    const WindowOrder order = layout.order(march);
    for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
      out.push_back({march, order.window(rank)});
    }
  }
  return out;
}

}  // namespace

std::vector<bool> required_visits(const RunLayout& layout, const Recalls& recalls,
                                  const IsDropped& is_dropped) {
  const BlockRoute route(layout);
  const std::vector<WindowKey> windows = in_order(layout);
  std::vector<bool> may_differ(layout.windows());
  for (const WindowKey& key : windows) {
    const std::vector<BlockVersion> inputs = route.inputs(key);
    const bool are_known = std::none_of(inputs.begin(), inputs.end(), [&](const BlockVersion& v) {
      return may_differ[layout.window(v.from)];
    });
    may_differ[layout.window(key)] = !are_known || !recalls(key);
  }
  std::vector<bool> required(layout.windows());
  std::for_each(windows.rbegin(), windows.rend(), [&](const WindowKey& key) {
    const std::uint64_t window = layout.window(key);
    if (!may_differ[window] && !required[window]) return;
    for (const BlockVersion& input : route.inputs(key)) {
      const std::uint64_t from = layout.window(input.from);
      if (is_dropped(from)) required[from] = true;
    }
  });
  return required;
}

}  // namespace mw::engine
