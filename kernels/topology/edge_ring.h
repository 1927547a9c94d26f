// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The ring of tetrahedra around an edge, in cyclic order.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Tets around edge (p, q): tet i is (p, q, vertices[i], vertices[i + 1 mod n]), positive, with
/// labels[i].  The ring may contain infinity().
struct EdgeRing {
  std::vector<LocalVertex> vertices;
  std::vector<Label> labels;
  std::vector<LocalVertex> ends;  ///< ends[i] == vertices[i + 1 mod n]

  [[nodiscard]] std::size_t size() const { return vertices.size(); }
};

/// Collects the tets around (p, q) into `ring` in the order of p's star: tet i is (p, q,
/// vertices[i], ends[i]), positive.  They are a whole ring if p is free.  Cost: O(star(p)).
void collect_ring_tets(const TetMesh& mesh, LocalVertex p, LocalVertex q, EdgeRing& ring);

/// Collects the ring of (p, q) into `ring`, keeping its capacity.
/// ENSURES: false when the loaded tets around the edge do not close to one cycle (part of them is
/// not loaded) or when there are none; `ring` is then meaningless.  Cost: O(star(p) + n^2).
[[nodiscard]] bool collect_ring(const TetMesh& mesh, LocalVertex p, LocalVertex q, EdgeRing& ring);

}  // namespace mw
