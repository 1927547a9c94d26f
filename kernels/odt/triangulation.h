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

/// A point, in lattice units times the ratio of the voxel's edges, relative to the window's lower
/// corner: whole numbers, exact, when voxels are cubes.
using PlcPoint = std::array<double, 3>;

/// A piecewise linear complex: facets that a triangulation must contain, and further points.
struct Plc {
  std::vector<PlcPoint> points;
  std::vector<std::array<std::uint32_t, 3>> facets;  ///< rows of points, ascending
  std::vector<PlcPoint> seeds;  ///< one inside each region that the facets bound
};

/// Nobody vouches for one: Replacement proves each tet before it is used.
struct Triangulation {
  std::vector<PlcPoint> added;  ///< Steiner points; rows follow those of the points asked for
  std::vector<std::array<std::uint32_t, 4>> tets;  ///< either orientation
  std::vector<std::uint32_t> regions;  ///< of each tet the number of its seed; others: no region
};

/// Makes the triangulation; none when it cannot.  REQUIRES of an implementation: a pure function.
using Triangulate = std::function<std::optional<Triangulation>(const Plc&)>;

}  // namespace mw
