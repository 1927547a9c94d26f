// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/surface/precomputed/triangle_surface.h"

#include <algorithm>
#include <cmath>

namespace mw::io {

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
