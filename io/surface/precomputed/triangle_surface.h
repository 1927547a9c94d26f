// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A surface in memory.
#pragma once

#include <vector>

#include "io/surface/surface_sink.h"

namespace mw::io {

struct TriangleSurface {
  std::vector<Position> vertices;
  std::vector<Triangle> triangles;
};

/// Lengths of the edges of all triangles; 0 where there are none.
struct EdgeLengths {
  double mean = 0;
  double longest = 0;
};
[[nodiscard]] EdgeLengths edge_lengths(const TriangleSurface& surface);

}  // namespace mw::io
