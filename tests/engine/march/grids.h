// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Grids by their number of windows, and relations among windows, for tests of the march.
#pragma once

#include "engine/window/window_order.h"
#include "tests/testing.h"

namespace mw::engine::test {

inline constexpr std::array<Order, 2> kOrders{Order::kRaster, Order::kColour};

/// A grid of that many windows.
[[nodiscard]] inline WindowGrid grid_of(Index3 windows, int window = 4) {
  const std::int64_t edge = window / 2;
  return {{(windows.x + 1) * edge, (windows.y + 1) * edge, (windows.z + 1) * edge}, window};
}

/// before[w][v]: v must be finished before w starts; by rank.
using Relation = std::vector<std::vector<bool>>;

/// What the edges of an order say.
[[nodiscard]] inline Relation by_edges(const WindowOrder& order) {
  Relation out(order.size(), std::vector<bool>(order.size(), false));
  for (std::uint64_t w = 0; w < order.size(); ++w) {
    for (Index3 p : order.predecessors(order.window(w))) out[w][order.rank(p)] = true;
  }
  return out;
}

/// REQUIRES: direct relates windows to those of lower rank only.
[[nodiscard]] inline Relation transitive_closure(const Relation& direct) {
  Relation out = direct;
  for (std::size_t w = 0; w < out.size(); ++w) {
    for (std::size_t v = 0; v < w; ++v) {
      if (!direct[w][v]) continue;
      for (std::size_t u = 0; u < v; ++u) {
        if (out[v][u]) out[w][u] = true;
      }
    }
  }
  return out;
}

}  // namespace mw::engine::test
