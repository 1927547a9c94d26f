// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A surface with less detail, for viewers that look at it from afar.
#pragma once

#include <vector>

#include "io/surface/surface_sink.h"

namespace mw::io {

struct TriangleSurface {
  std::vector<Position> vertices;
  std::vector<Triangle> triangles;
};

/// Joins all vertices in one cube of a grid at their mean, and drops triangles that are left with
/// fewer than three corners, and copies of others (vertex clustering of Rossignac and Borrel).
/// Topology is not kept.  origin is a corner of the grid, not above any vertex.
/// REQUIRES: cell, the edge of the grid's cubes, is positive.
/// ENSURES: no vertex moves by more than the diagonal of a cube; each is the corner of a triangle;
/// the same surface gives the same result.  Cost: O(n log n).
[[nodiscard]] TriangleSurface clustered(const TriangleSurface& fine, const Position& origin,
                                        double cell);

/// Lengths of the edges of all triangles; 0 where there are none.
struct EdgeLengths {
  double mean = 0;
  double longest = 0;
};
[[nodiscard]] EdgeLengths edge_lengths(const TriangleSurface& surface);

}  // namespace mw::io
