// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sorts vertices by the cubes that they lie in.
#include "io/surface/precomputed/coarser_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace mw::io {
namespace {

using Cube = std::array<std::int64_t, 3>;

std::vector<Cube> cubes_of(const std::vector<Position>& vertices, const Position& origin,
                           double cell) {
  std::vector<Cube> out;
  out.reserve(vertices.size());
  for (const Position& p : vertices) {
    Cube& cube = out.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      cube[k] = static_cast<std::int64_t>(std::floor((p[k] - origin[k]) / cell));
    }
  }
  return out;
}

/// Rows of vertices by cube, those of one cube ascending.
std::vector<std::uint64_t> sorted_rows(const std::vector<Cube>& cubes) {
  std::vector<std::uint64_t> rows(cubes.size());
  std::iota(rows.begin(), rows.end(), std::uint64_t{0});
  std::stable_sort(rows.begin(), rows.end(),
                   [&](std::uint64_t a, std::uint64_t b) { return cubes[a] < cubes[b]; });
  return rows;
}

/// Returns the triangle with its smallest corner first and in the same direction.
Triangle turned(const Triangle& t) {
  if (t[1] < t[0] && t[1] < t[2]) return {t[1], t[2], t[0]};
  if (t[2] < t[0] && t[2] < t[1]) return {t[2], t[0], t[1]};
  return t;
}

/// Keeps one triangle of those with the same three corners, in either direction: the one that comes
/// first in the order of rows.
void drop_copies(std::vector<Triangle>& triangles) {
  const auto corners = [](Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  for (Triangle& t : triangles) t = turned(t);
  std::sort(triangles.begin(), triangles.end(), [&](const Triangle& a, const Triangle& b) {
    const Triangle x = corners(a), y = corners(b);
    return x != y ? x < y : a < b;
  });
  const auto is_copy = [&](const Triangle& a, const Triangle& b) {
    return corners(a) == corners(b);
  };
  triangles.erase(std::unique(triangles.begin(), triangles.end(), is_copy), triangles.end());
}

void drop_unused_vertices(TriangleSurface& surface) {
  constexpr std::uint64_t kUnused = ~std::uint64_t{0};
  std::vector<std::uint64_t> rows(surface.vertices.size(), kUnused);
  for (const Triangle& t : surface.triangles) {
    for (const std::uint64_t v : t) rows[v] = 0;
  }
  std::uint64_t used = 0;
  for (std::size_t v = 0; v < rows.size(); ++v) {
    if (rows[v] == kUnused) continue;
    rows[v] = used;
    surface.vertices[used++] = surface.vertices[v];
  }
  surface.vertices.resize(used);
  for (Triangle& t : surface.triangles) {
    for (std::uint64_t& v : t) v = rows[v];
  }
}

}  // namespace

TriangleSurface clustered(const TriangleSurface& fine, const Position& origin, double cell) {
  const std::vector<Cube> cubes = cubes_of(fine.vertices, origin, cell);
  std::vector<std::uint64_t> becomes(fine.vertices.size());
  TriangleSurface out;
  double count = 0;
  const Cube* last = nullptr;
  for (const std::uint64_t row : sorted_rows(cubes)) {
    if (last == nullptr || *last != cubes[row]) {
      out.vertices.push_back({});
      count = 0;
    }
    last = &cubes[row];
    becomes[row] = out.vertices.size() - 1;
    count += 1;
    Position& mean = out.vertices.back();
    for (std::size_t k = 0; k < 3; ++k) mean[k] += (fine.vertices[row][k] - mean[k]) / count;
  }
  for (const Triangle& t : fine.triangles) {
    const Triangle moved{becomes[t[0]], becomes[t[1]], becomes[t[2]]};
    if (moved[0] == moved[1] || moved[1] == moved[2] || moved[2] == moved[0]) continue;
    out.triangles.push_back(moved);
  }
  drop_copies(out.triangles);
  drop_unused_vertices(out);
  return out;
}

EdgeLengths edge_lengths(const TriangleSurface& surface) {
  EdgeLengths out;
  double sum = 0;
  for (const Triangle& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Position& a = surface.vertices[t[i]];
      const Position& b = surface.vertices[t[(i + 1) % 3]];
      const double length = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      sum += length;
      out.longest = std::max(out.longest, length);
    }
  }
  const auto edges = 3.0 * static_cast<double>(surface.triangles.size());
  if (edges > 0) out.mean = sum / edges;
  return out;
}

}  // namespace mw::io
