// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Radius ratios of several tets at once.
#pragma once

#include "kernels/core/lanes.h"
#include "kernels/core/lattice.h"
#include "kernels/core/metric.h"

namespace mw {

/// Up to four tets, each by its edges from one vertex to the other three.
struct TetLanes {
  std::array<StoredInts, 9> edges{};  ///< x, y, z of a, b, c, in lattice units

  void set(std::size_t lane, Point v, Point a, Point b, Point c) {
    std::size_t i = 0;
    for (const Point p : {a, b, c}) {
      edges[i++][lane] = p.x - v.x;
      edges[i++][lane] = p.y - v.y;
      edges[i++][lane] = p.z - v.z;
    }
  }
};

/// Returns radius_ratio() (kernels/quality/quality.h) of each tet, to the last bit, and any number
/// for lanes that were not set.
[[nodiscard]] StoredLanes radius_ratios(const TetLanes& tets, const Metric& metric);

}  // namespace mw
