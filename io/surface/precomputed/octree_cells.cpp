// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cuts along planes from below, axis by axis, so that each edge is cut at the same places in all
// triangles that have it.
#include "io/surface/precomputed/octree_cells.h"

#include <algorithm>
#include <map>

#include "io/volume/precomputed/sharding.h"

namespace mw::io {
namespace {

/// Returns the lowest plane above a coordinate.
std::int64_t plane_above(std::int64_t at, bool halves) {
  const std::int64_t cell = at / kCellSteps * kCellSteps;
  return halves && at - cell < kHalfCell ? cell + kHalfCell : cell + kCellSteps;
}

/// Returns a * b / c, rounded to the nearest whole number.  REQUIRES: c > 0.
std::int64_t scaled(std::int64_t a, std::int64_t b, std::int64_t c) {
  const std::int64_t twice = 2 * a * b + c;
  const std::int64_t quotient = twice / (2 * c);
  return quotient - (twice % (2 * c) < 0 ? 1 : 0);
}

/// Cuts a surface along planes across one axis.
class AxisCutter {
 public:
  /// REQUIRES: surface outlives it.
  AxisCutter(SteppedSurface& surface, std::size_t axis, bool halves)
      : surface_(surface), axis_(axis), halves_(halves) {}

  void run() {
    std::vector<Triangle> rest;
    rest.swap(surface_.triangles);
    for (const Triangle& t : rest) cut(t);
  }

 private:
  [[nodiscard]] std::int64_t at(std::uint64_t vertex) const {
    return surface_.vertices[vertex][axis_];
  }

  /// Returns the vertex where the plane cuts the edge of u and v.
  std::uint64_t vertex_on(std::uint64_t u, std::uint64_t v, std::int64_t plane) {
    if (v < u) std::swap(u, v);
    const auto [found, is_new] = cuts_.try_emplace({u, v}, surface_.vertices.size());
    if (!is_new) return found->second;
    const Steps from = surface_.vertices[u], to = surface_.vertices[v];
    const bool up = to[axis_] > from[axis_];
    const Steps& low = up ? from : to;
    const Steps& high = up ? to : from;
    Steps cut{};
    for (std::size_t k = 0; k < 3; ++k) {
      cut[k] = low[k] + scaled(high[k] - low[k], plane - low[axis_], high[axis_] - low[axis_]);
    }
    surface_.vertices.push_back(cut);
    return found->second;
  }

  /// Appends the part below the lowest plane that cuts the triangle, and cuts the part above it.
  void cut(Triangle t) {
    const std::int64_t low = std::min({at(t[0]), at(t[1]), at(t[2])});
    const std::int64_t high = std::max({at(t[0]), at(t[1]), at(t[2])});
    const std::int64_t plane = plane_above(low, halves_);
    if (plane >= high) {
      surface_.triangles.push_back(t);
      return;
    }
    std::vector<std::uint64_t> below, above;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t u = t[i], v = t[(i + 1) % 3];
      if (at(u) <= plane) below.push_back(u);
      if (at(u) >= plane) above.push_back(u);
      if ((at(u) < plane && at(v) > plane) || (at(u) > plane && at(v) < plane)) {
        const std::uint64_t cut_vertex = vertex_on(u, v, plane);
        below.push_back(cut_vertex);
        above.push_back(cut_vertex);
      }
    }
    for (std::size_t i = 2; i < below.size(); ++i) {
      surface_.triangles.push_back({below[0], below[i - 1], below[i]});
    }
    for (std::size_t i = 2; i < above.size(); ++i) cut({above[0], above[i - 1], above[i]});
  }

  SteppedSurface& surface_;
  std::size_t axis_;
  bool halves_;
  std::map<std::array<std::uint64_t, 2>, std::uint64_t> cuts_;  ///< by edge, smaller row first
};

Index3 cell_of(const SteppedSurface& surface, const Triangle& t, Index3 grid) {
  const auto along = [&](std::size_t k, std::int64_t extent) {
    const auto& vertices = surface.vertices;
    const std::int64_t low = std::min({vertices[t[0]][k], vertices[t[1]][k], vertices[t[2]][k]});
    return std::min(low / kCellSteps, extent - 1);
  };
  return {along(0, grid.x), along(1, grid.y), along(2, grid.z)};
}

/// Gives the triangles of each cell vertices of their own, in the order in which they come.
class PartMaker {
 public:
  /// REQUIRES: surface outlives it.
  explicit PartMaker(const SteppedSurface& surface)
      : surface_(surface), rows_(surface.vertices.size()) {}

  void begin(Index3 cell) {
    ++part_;
    out_.push_back({cell, {}});
  }

  void add(const Triangle& t) {
    Triangle own{};
    for (std::size_t i = 0; i < 3; ++i) own[i] = row_of(t[i]);
    out_.back().surface.triangles.push_back(own);
  }

  std::vector<CellPart> take() { return std::move(out_); }

 private:
  struct Row {
    std::uint64_t part = 0;  ///< counted from 1
    std::uint64_t row = 0;
  };

  std::uint64_t row_of(std::uint64_t vertex) {
    auto& [cell, own] = out_.back();
    Row& known = rows_[vertex];
    if (known.part == part_) return known.row;
    known = {part_, own.vertices.size()};
    const Steps& p = surface_.vertices[vertex];
    own.vertices.push_back(
        {p[0] - cell.x * kCellSteps, p[1] - cell.y * kCellSteps, p[2] - cell.z * kCellSteps});
    return known.row;
  }

  const SteppedSurface& surface_;
  std::uint64_t part_ = 0;
  std::vector<Row> rows_;
  std::vector<CellPart> out_;
};

}  // namespace

std::vector<CellPart> cut_into_cells(SteppedSurface surface, Index3 grid, bool halves) {
  for (std::size_t axis = 0; axis < 3; ++axis) AxisCutter(surface, axis, halves).run();
  struct Placed {
    std::uint64_t code = 0;
    std::uint64_t triangle = 0;
  };
  std::vector<Placed> order;
  order.reserve(surface.triangles.size());
  for (const Triangle& t : surface.triangles) {
    order.push_back({morton_code(cell_of(surface, t, grid), grid), order.size()});
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const Placed& a, const Placed& b) { return a.code < b.code; });
  PartMaker parts(surface);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Triangle& t = surface.triangles[order[i].triangle];
    if (i == 0 || order[i].code != order[i - 1].code) parts.begin(cell_of(surface, t, grid));
    parts.add(t);
  }
  return parts.take();
}

}  // namespace mw::io
