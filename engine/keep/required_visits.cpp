// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Walks forwards to the windows that an edit may reach, then backwards to what these need.
#include "engine/keep/required_visits.h"

#include <algorithm>

#include "engine/store/run_layout.h"

namespace mw::engine {
namespace {

/// Calls use for the windows of all marches in the order of the run.
template <typename Use>
void forwards(const RunLayout& layout, Use use) {
  for (std::uint32_t march = 0; march < layout.marches(); ++march) {
    const WindowOrder order = layout.order(march);
    for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
      use(WindowKey{march, order.window(rank)});
    }
  }
}

/// Calls use for these windows from the last to the first.
template <typename Use>
void backwards(const RunLayout& layout, Use use) {
  for (std::uint32_t march = layout.marches(); march-- > 0;) {
    const WindowOrder order = layout.order(march);
    for (std::uint64_t rank = order.size(); rank-- > 0;) use(WindowKey{march, order.window(rank)});
  }
}

}  // namespace

std::vector<bool> required_visits(const RunLayout& layout, const Recalls& recalls,
                                  const IsDropped& is_dropped) {
  const BlockRoute route(layout);
  std::vector<bool> may_differ(layout.windows());
  forwards(layout, [&](const WindowKey& key) {
    const std::vector<BlockVersion> inputs = route.inputs(key);
    const bool are_known = std::none_of(inputs.begin(), inputs.end(), [&](const BlockVersion& v) {
      return may_differ[layout.window(v.from)];
    });
    may_differ[layout.window(key)] = !are_known || !recalls(key);
  });
  std::vector<bool> required(layout.windows());
  backwards(layout, [&](const WindowKey& key) {
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
