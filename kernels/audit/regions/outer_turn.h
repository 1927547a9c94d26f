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
  std::uint32_t side = 0;          ///< number of the triangle
  const Position* p = nullptr;     ///< at an edge its third vertex, at a vertex its second
  const Position* q = nullptr;     ///< at a vertex its third
  const Position* apex = nullptr;  ///< apex of the region's tet on it
};

using UniteSides = std::function<void(std::uint32_t, std::uint32_t)>;

/// Unites those triangles at edge (a, b) between which a turn around the edge leads from one to the
/// other outside of the region.  Leaves wings in another order.
void unite_around_edge(const Position& a, const Position& b, std::vector<BoundaryWing>& wings,
                       const UniteSides& unite);

/// A tet of a region at a vertex, by its three other corners.
using Cone = std::array<const Position*, 3>;

/// Unites triangles at vertex v, where the region falls into several clusters that share only v;
/// cones has a tet of each.  Triangles of different clusters bound the same gap between them when
/// they follow each other on a way from one cluster to another.
void unite_around_vertex(const Position& v, std::span<const BoundaryWing> wings,
                         std::span<const Cone> cones, const UniteSides& unite);

}  // namespace mw::audit
