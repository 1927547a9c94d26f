// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a constrained Delaunay triangulation is asked (Sec 5.5), and what it answers.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace mw {

/// A point relative to the window's lower corner, in lattice units times the ratio of the voxel's
/// edges.  When voxels are cubes, its coordinates are whole numbers, and exact.
using PlcPoint = std::array<double, 3>;

/// A piecewise linear complex: facets that a triangulation must contain, and further points.
struct Plc {
  std::vector<PlcPoint> points;
  std::vector<std::array<std::uint32_t, 3>> facets;  ///< rows of points, ascending
  std::vector<PlcPoint> seeds;  ///< one inside each region that the facets bound
};

/// A triangulation is not trusted: replace_proved() proves each tet before it is used.
struct Triangulation {
  std::vector<PlcPoint> added;  ///< Steiner points; rows follow those of the points asked for
  std::vector<std::array<std::uint32_t, 4>> tets;  ///< either orientation
  std::vector<std::uint32_t> regions;  ///< number of each tet's seed; other numbers mean no region
};

/// Makes the triangulation, or nothing when it cannot.  An implementation must be a pure function.
using Triangulate = std::function<std::optional<Triangulation>(const Plc&)>;

}  // namespace mw
