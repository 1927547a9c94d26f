// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sequence and edges of the raster and of the colour order.
#include "engine/window/window_order.h"

#include <algorithm>
#include <array>
#include <bit>

namespace mw::engine {
namespace {

std::array<std::int64_t, 3> axes(Index3 i) {
  return {i.x, i.y, i.z};
}

/// Returns the place of index i in 0, 2, 1, 4, 3, ... below count, where odd indices come after
/// those beside them.  It is its own inverse.
std::int64_t even_first(std::int64_t i, std::int64_t count) {
  return i % 2 == 0 ? std::max<std::int64_t>(i - 1, 0) : std::min(i + 1, count - 1);
}

/// Returns the place of index i in 1, 0, 3, 2, 5, ... below count, where even indices come after
/// those beside them.  It is its own inverse.
std::int64_t odd_first(std::int64_t i, std::int64_t count) {
  return i % 2 == 0 ? std::min(i + 1, count - 1) : i - 1;
}

std::int64_t place(std::int64_t i, std::int64_t count, std::int64_t parity) {
  return parity % 2 == 0 ? even_first(i, count) : odd_first(i, count);
}

/// Returns the window at a place of the colour order's sequence; places are given as indices, too.
Index3 colour_window(Index3 at, Index3 windows) {
  const std::int64_t z = place(at.z, windows.z, 0), y = place(at.y, windows.y, z);
  return {place(at.x, windows.x, y + z), y, z};
}

/// The inverse of colour_window().
Index3 colour_place(Index3 w, Index3 windows) {
  return {place(w.x, windows.x, w.y + w.z), place(w.y, windows.y, w.z), place(w.z, windows.z, 0)};
}

/// Returns the colour: the place of the parities in their Gray code, over those axes that have
/// several windows.
std::int64_t colour_step(Index3 window, Index3 windows) {
  std::int64_t step = 0, parity = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    parity ^= axes(window)[axis] % 2;
    if (axes(windows)[axis] > 1) step = 2 * step + parity;
  }
  return step;
}

/// Returns the windows beside this one along the axis in which the colours of steps `step` - 1 and
/// `step` differ, which is that of the lowest bit set in `step`.
std::vector<Index3> beside(Index3 window, Index3 windows, std::int64_t step) {
  std::vector<Index3> out;
  auto bit = std::countr_zero(static_cast<std::uint64_t>(step));
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (axes(windows)[axis] == 1 || bit-- != 0) continue;
    for (const Index3 w : {window - axis_vector(axis), window + axis_vector(axis)}) {
      if (Box3{{0, 0, 0}, windows}.contains(w)) out.push_back(w);
    }
  }
  return out;
}

/// Edges lead from each colour to the next.  Between two colours the number of steps along an axis
/// is odd where parities differ, else even.  So of two windows that share a block, one is reached
/// from the other, since steps along an axis may go there and back.
std::vector<Index3> colour_predecessors(Index3 window, Index3 windows) {
  const std::int64_t step = colour_step(window, windows);
  return step == 0 ? std::vector<Index3>{} : beside(window, windows, step);
}

std::vector<Index3> colour_successors(Index3 window, Index3 windows) {
  return beside(window, windows, colour_step(window, windows) + 1);
}

/// The inverse of WindowGrid::predecessors().
std::vector<Index3> raster_successors(Index3 w, Index3 windows) {
  std::vector<Index3> out;
  // Returns the range of indices whose +1, clamped, is i: the one before, and the last one itself.
  const auto clamped_to = [](std::int64_t i, std::int64_t count) {
    return Index3{std::max<std::int64_t>(i - 1, 0), i == count - 1 ? i : i - 1, 0};
  };
  const Index3 x = clamped_to(w.x, windows.x), y = clamped_to(w.y, windows.y);
  if (w.x + 1 < windows.x) out.push_back({w.x + 1, w.y, w.z});
  if (w.y + 1 < windows.y) {
    for (std::int64_t i = x.x; i <= x.y; ++i) out.push_back({i, w.y + 1, w.z});
  }
  if (w.z + 1 < windows.z) {
    for_each_index(Box3{{x.x, y.x, w.z + 1}, {x.y + 1, y.y + 1, w.z + 2}},
                   [&](Index3 s) { out.push_back(s); });
  }
  return out;
}

/// A row begins two steps after the one before it, and a layer two rows after the one before it; it
/// is one step or row where there is only one window or row to wait for.
std::int64_t raster_step(Index3 window, Index3 windows) {
  const std::int64_t row = std::min<std::int64_t>(windows.x, 2);
  const std::int64_t layer = row * std::min<std::int64_t>(windows.y, 2);
  return window.x + row * window.y + layer * window.z;
}

}  // namespace

Index3 WindowOrder::window(std::uint64_t rank) const {
  const Index3 index = index_at(rank, grid_.windows());
  return order_ == Order::kRaster ? index : colour_window(index, grid_.windows());
}

std::uint64_t WindowOrder::rank(Index3 window) const {
  const Index3 index = order_ == Order::kRaster ? window : colour_place(window, grid_.windows());
  return raster(index, grid_.windows());
}

std::vector<Index3> WindowOrder::predecessors(Index3 window) const {
  return order_ == Order::kRaster ? grid_.predecessors(window)
                                  : colour_predecessors(window, grid_.windows());
}

std::vector<Index3> WindowOrder::successors(Index3 window) const {
  return order_ == Order::kRaster ? raster_successors(window, grid_.windows())
                                  : colour_successors(window, grid_.windows());
}

std::vector<Index3> WindowOrder::neighbours(Index3 window) const {
  std::vector<Index3> out;
  const Box3 around{window - Index3{1, 1, 1}, window + Index3{2, 2, 2}};
  for_each_index(intersection(around, {{0, 0, 0}, grid_.windows()}), [&](Index3 w) {
    if (w != window) out.push_back(w);
  });
  return out;
}

std::vector<Index3> WindowOrder::earlier_neighbours(Index3 window) const {
  std::vector<Index3> out = neighbours(window);
  std::erase_if(out, [&](Index3 w) { return rank(w) > rank(window); });
  return out;
}

std::vector<Index3> WindowOrder::later_neighbours(Index3 window) const {
  std::vector<Index3> out = neighbours(window);
  std::erase_if(out, [&](Index3 w) { return rank(w) < rank(window); });
  return out;
}

std::int64_t WindowOrder::step(Index3 window) const {
  return order_ == Order::kRaster ? raster_step(window, grid_.windows())
                                  : colour_step(window, grid_.windows());
}

std::int64_t WindowOrder::steps() const {
  const Index3 count = grid_.windows();
  if (order_ == Order::kRaster) return raster_step(count - Index3{1, 1, 1}, count) + 1;
  std::int64_t colours = 1;
  for (std::int64_t along : axes(count)) colours *= std::min<std::int64_t>(along, 2);
  return colours;
}

}  // namespace mw::engine
