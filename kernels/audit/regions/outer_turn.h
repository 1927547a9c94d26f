// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which boundary triangles of a region bound the same gap, at an edge and at a vertex.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "kernels/audit/subject.h"

namespace mw::audit {

/// A triangle of a region's boundary, seen from one of its edges or vertices.
struct BoundaryWing {
  std::uint32_t side = 0;          ///< whose triangle
  const Position* p = nullptr;     ///< its third vertex, or its second
  const Position* q = nullptr;     ///< at a vertex: its third
  const Position* apex = nullptr;  ///< of the region's tet on it
};

using UniteSides = std::function<void(std::uint32_t, std::uint32_t)>;

/// The triangles at edge (a, b): unites those that a turn around the edge outside of the region
/// leads from one to the other.
void unite_around_edge(const Position& a, const Position& b, std::vector<BoundaryWing>& wings,
                       const UniteSides& unite);

/// A tet of a region at a vertex: its three other corners.
using Cone = std::array<const Position*, 3>;

/// The triangles at vertex v, where the region falls into several clusters that share only v; cones
/// has a tet of each.  Unites triangles of different clusters that bound the same gap between them:
/// those that follow each other on a way from one cluster to another.
void unite_around_vertex(const Position& v, std::span<const BoundaryWing> wings,
                         std::span<const Cone> cones, const UniteSides& unite);

}  // namespace mw::audit
