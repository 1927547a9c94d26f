// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sequence and edges of the raster and of the colour order.
#include "engine/march/window_order.h"

#include <algorithm>
#include <array>

namespace mw::engine {
namespace {

std::array<std::int64_t, 3> axes(Index3 i) {
  return {i.x, i.y, i.z};
}

/// Place of index i in 0, 2, 1, 4, 3, 6, 5, ... below count; its own inverse.
std::int64_t even_first(std::int64_t i, std::int64_t count) {
  return i % 2 == 0 ? std::max<std::int64_t>(i - 1, 0) : std::min(i + 1, count - 1);
}

Index3 even_first(Index3 i, Index3 count) {
  return {even_first(i.x, count.x), even_first(i.y, count.y), even_first(i.z, count.z)};
}

/// Index3 of a place in an x-fastest array of shape s.
Index3 unraster(std::uint64_t index, Index3 s) {
  const auto i = static_cast<std::int64_t>(index);
  return {i % s.x, i / s.x % s.y, i / s.x / s.y};
}

/// First of the axes with several windows along which the window is even (parity 0) or odd (1);
/// 3 when there is none.
std::size_t first_axis(Index3 window, Index3 windows, std::int64_t parity) {
  std::size_t axis = 0;
  while (axis < 3 && (axes(windows)[axis] == 1 || axes(window)[axis] % 2 != parity)) ++axis;
  return axis;
}

/// Windows one away along each axis up to `last` (axes of a single window aside), in line with this
/// one along the others.
std::vector<Index3> diagonal_neighbours(Index3 window, Index3 windows, std::size_t last) {
  std::vector<Index3> out;
  for_each_index(Box3{{-1, -1, -1}, {2, 2, 2}}, [&](Index3 d) {
    for (std::size_t a = 0; a < 3; ++a) {
      const bool moves = a <= last && axes(windows)[a] > 1;
      if ((axes(d)[a] != 0) != moves) return;
    }
    if (Box3{{0, 0, 0}, windows}.contains(window + d)) out.push_back(window + d);
  });
  return out;
}

/// Edges lead from each colour to the next.  With a the least significant odd axis, the neighbours
/// of the colour before are odd along all axes below a, and every other earlier neighbour precedes
/// one of them.
std::vector<Index3> colour_predecessors(Index3 window, Index3 windows) {
  const std::size_t axis = first_axis(window, windows, 1);
  return axis == 3 ? std::vector<Index3>{} : diagonal_neighbours(window, windows, axis);
}

std::vector<Index3> colour_successors(Index3 window, Index3 windows) {
  const std::size_t axis = first_axis(window, windows, 0);
  return axis == 3 ? std::vector<Index3>{} : diagonal_neighbours(window, windows, axis);
}

/// The inverse of WindowGrid::predecessors().
std::vector<Index3> raster_successors(Index3 w, Index3 windows) {
  std::vector<Index3> out;
  // Whose +1, clamped, is i: the one before, and the last itself.
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

/// A row is its predecessor's two steps later, a layer two rows, unless there is only one window
/// or row to wait for.
std::int64_t raster_step(Index3 window, Index3 windows) {
  const std::int64_t row = std::min<std::int64_t>(windows.x, 2);
  const std::int64_t layer = row * std::min<std::int64_t>(windows.y, 2);
  return window.x + row * window.y + layer * window.z;
}

std::int64_t colour_step(Index3 window, Index3 windows) {
  std::int64_t colour = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    if (axes(windows)[axis] > 1) colour = 2 * colour + axes(window)[axis] % 2;
  }
  return colour;
}

}  // namespace

Index3 WindowOrder::window(std::uint64_t rank) const {
  const Index3 index = unraster(rank, grid_.windows());
  return order_ == Order::kRaster ? index : even_first(index, grid_.windows());
}

std::uint64_t WindowOrder::rank(Index3 window) const {
  const Index3 index = order_ == Order::kRaster ? window : even_first(window, grid_.windows());
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
