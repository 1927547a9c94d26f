// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "kernels/quality/halved_tet.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/elementary.h"
#include "kernels/core/tet_nodes.h"
#include "kernels/quality/quality.h"

namespace mw {
namespace {

using Parts = std::array<std::array<std::size_t, 4>, 8>;

/// The node that each of the ten goes to when the corners 1, 2 and 3 change places in a circle.
constexpr std::array<std::size_t, 10> kTurned{0, 2, 3, 1, 6, 9, 7, 4, 5, 8};

Parts turned(const Parts& parts) {
  Parts out = parts;
  for (auto& part : out) {
    for (std::size_t& node : part) node = kTurned[node];
  }
  return out;
}

/// The first of the four parts around the diagonal.
constexpr std::size_t kFirstInner = 4;

double least_ratio(const Parts& parts, const std::array<Vec3, 10>& nodes) {
  double least = 1.0;
  for (std::size_t i = kFirstInner; i < parts.size(); ++i) {
    const Vec3& at = nodes[parts[i][0]];
    least = std::min(least, radius_ratio({nodes[parts[i][1]] - at, nodes[parts[i][2]] - at,
                                          nodes[parts[i][3]] - at}));
  }
  return least;
}

}  // namespace

Parts halved_tet(const std::array<Vec3, 10>& nodes) {
  Parts best = kTetParts, next = kTetParts;
  double ratio = least_ratio(best, nodes);
  for (int diagonal = 1; diagonal < 3; ++diagonal) {
    next = turned(next);
    const double other = least_ratio(next, nodes);
    if (!(other > ratio)) continue;
    ratio = other;
    best = next;
  }
  return best;
}

double halved_floor(double floor) {
  constexpr double kShare = 1.8, kMost = 0.4;
  const double counted = std::min(floor, kMost);
  if (!(counted > 0.0)) return 0.0;
  const double kept = kShare * counted * counted;
  constexpr double kRounded = 1e-300;  // less has no three digits that could be kept
  if (kept < kRounded) return 0.0;
  const double scale = 100 / power_of_ten_below(kept);
  return std::floor(kept * scale) / scale;
}

double halved_floor(double floor, int times) {
  for (int i = 0; i < times; ++i) floor = halved_floor(floor);
  return floor;
}

}  // namespace mw
