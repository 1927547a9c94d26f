// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Betti numbers of every label of a volume and of a mesh (promise P1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/audit/subject.h"

namespace mw::audit {

/// Components, tunnels and cavities of one space.
struct Betti {
  std::int64_t b0 = 0;
  std::int64_t b1 = 0;
  std::int64_t b2 = 0;

  friend bool operator==(const Betti&, const Betti&) = default;
};

/// closed is about the closure of the label's cells, which meet through vertices, edges and faces.
/// open is about the interior of the union of the label's cells, which meet through faces only.
struct RegionBetti {
  Betti closed;
  Betti open;

  friend bool operator==(const RegionBetti&, const RegionBetti&) = default;
};

/// Betti numbers of every label of a mesh (P1; kernels/topology/README.md, "Betti numbers of closed
/// and open regions").  Everything outside the box is one more cell, which makes the whole a
/// 3-sphere, and one more label; triangles with one tet bound it.  Tets with a repeated vertex are
/// left out.  Where the mesh is not a partition of a box (judge_validity), the numbers are
/// indicative only.
/// Returns label_count + 1 rows; the last is the exterior.  A label that does not occur is all 0.
/// REQUIRES: labels parallel to tets, vertex rows in range.
/// Errors: kInput when these fail, kResource above 2^31 tets or from 2^32 - 1 vertices on.
/// Cost: O(T) plus small sorts a vertex star, and O(E log E + E log L log P) for P face-connected
/// parts, E pairs of parts that touch and L labels; 20 bytes a tet, 30 a vertex, some 16 a pair.
[[nodiscard]] std::vector<RegionBetti> mesh_betti(const AuditMesh& mesh, std::size_t label_count);

}  // namespace mw::audit
