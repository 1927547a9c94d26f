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

/// Betti numbers of every label of a volume (P1; kernels/topology/README.md, "Betti numbers of
/// closed and open regions").  Everything outside the box is one more cell, which makes the whole a
/// 3-sphere, and one more label.
/// Returns label_count + 1 rows; the last is the exterior.  A label that does not occur is all 0.
/// REQUIRES: a shape of at least 1 x 1 x 1, as many labels as voxels, labels < label_count.
/// Errors: kInput when these fail, kResource from 2^32 - 1 runs of equal labels on.
/// Cost: one pass over the voxels, then O(R + E log E + E log L log P) for R runs along x, P
/// face-connected parts, E pairs of parts that touch and L labels; 8 bytes a run and some 16 a
/// pair. Deterministic.
[[nodiscard]] std::vector<RegionBetti> voxel_betti(const VoxelLabels& volume,
                                                   std::size_t label_count);

/// Betti numbers of every label of a mesh.  Triangles with one tet bound the exterior, which is one
/// cell.  Tets with a repeated vertex are left out.  Where the mesh is not a partition of a box
/// (check_validity), the numbers are indicative only.
/// REQUIRES: labels parallel to tets, vertex rows in range.
/// Errors: kInput when these fail, kResource above 2^31 tets or from 2^32 - 1 vertices on.
/// Cost: O(T) plus small sorts a vertex star, and the graph as above; 20 bytes a tet, 30 a vertex.
[[nodiscard]] std::vector<RegionBetti> mesh_betti(const AuditMesh& mesh, std::size_t label_count);

}  // namespace mw::audit
