// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Nearest point of a triangle by the region that the point projects into: a corner, an edge, or the
// inside (Ericson, Real-Time Collision Detection, 5.1.5); and packing and descending the trees.
#include "kernels/audit/distance/trees.h"

#include <cmath>

#include "kernels/core/vector3.h"

namespace mw::audit {

LabelTrees::Box LabelTrees::widened(const Extent& extent) {
  constexpr double kWidening = 1e-6;  // rounding to float moves a number by 6e-8 of it at most
  Box box{};
  for (std::size_t k = 0; k < 3; ++k) {
    box.lo[k] = static_cast<float>(extent.lo[k] - kWidening * (1 + std::abs(extent.lo[k])));
    box.hi[k] = static_cast<float>(extent.hi[k] + kWidening * (1 + std::abs(extent.hi[k])));
  }
  return box;
}

void LabelTrees::add_levels() {
  if (level_begin_.back() == levels_.size()) return;
  while (levels_.back().count > 1) {
    const Level below = levels_.back();
    const Level level{boxes_.size(), (below.count + kFan - 1) / kFan};
    for (std::uint64_t first = 0; first < below.count; first += kFan) {
      Box all = boxes_[below.begin + first];
      const std::uint64_t end = std::min(first + kFan, below.count);
      for (std::uint64_t i = first + 1; i < end; ++i) all = joined(all, boxes_[below.begin + i]);
      boxes_.push_back(all);
    }
    levels_.push_back(level);
  }
}

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Squared sine of the angle between two edges below which their plane is in doubt.
constexpr double kFlatness = 1e-6;

/// |r - s u - t v|^2
double squared_rest(const VoxelPoint& r, const VoxelPoint& u, double s, const VoxelPoint& v,
                    double t) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double rest = r[k] - (s * u[k] + t * v[k]);
    sum += rest * rest;
  }
  return sum;
}

/// Squared distance from p to the edge from a to a + way, with r = p - a.
double squared_to_edge(const VoxelPoint& r, const VoxelPoint& way) {
  const double length = dot(way, way);
  const double t = length > 0 ? std::clamp(dot(r, way) / length, 0.0, 1.0) : 0.0;
  return squared_rest(r, way, t, way, 0);
}

/// Spreads the bits to every third bit, from bit 0 on.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f00000000ffffULL;
  bits = (bits | bits << 16) & 0x001f0000ff0000ffULL;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
  return (bits | bits << 2) & 0x1249249249249249ULL;
}

}  // namespace

double squared_distance(const VoxelPoint& p, const VoxelTriangle& t) {
  const VoxelPoint ab = minus(t[1], t[0]);
  const VoxelPoint ac = minus(t[2], t[0]);
  const VoxelPoint ap = minus(p, t[0]);
  const double d1 = dot(ab, ap);
  const double d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return dot(ap, ap);
  const VoxelPoint bp = minus(p, t[1]);
  const double d3 = dot(ab, bp);
  const double d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return dot(bp, bp);
  const VoxelPoint cp = minus(p, t[2]);
  const double d5 = dot(ab, cp);
  const double d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return dot(cp, cp);
  // Twice the areas that p's projection makes with the edges, times the triangle's normal.
  const double at_c = d1 * d4 - d3 * d2;
  const double at_b = d5 * d2 - d1 * d6;
  const double at_a = d3 * d6 - d5 * d4;
  const double whole = at_a + at_b + at_c;
  const bool is_inside = at_a > 0 && at_b > 0 && at_c > 0;
  const double inside = is_inside ? squared_rest(ap, ab, at_b / whole, ac, at_c / whole) : kFar;
  // The areas in a flat triangle are rounding errors, and all its points are near an edge.
  const bool is_flat = whole <= kFlatness * dot(ab, ab) * dot(ac, ac);
  if (is_inside && !is_flat) return inside;
  return std::min({inside, squared_to_edge(ap, ab), squared_to_edge(ap, ac),
                   squared_to_edge(bp, minus(t[2], t[1]))});
}

std::uint64_t curve_position(const std::array<std::uint32_t, 3>& cell) {
  return spread(cell[0]) | spread(cell[1]) << 1 | spread(cell[2]) << 2;
}

}  // namespace mw::audit
