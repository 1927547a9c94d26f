// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts by union-find over the triangles.
#include "kernels/audit/topology/mesh_parts.h"

#include <algorithm>
#include <utility>

#include "kernels/core/sort_distinct.h"

namespace mw::audit {

Parts parts_of_mesh(const MeshStars& stars, Label exterior) {
  const std::size_t tets = stars.mesh().tets.size();
  DisjointSets sets(tets + 1);
  visit_whole_faces(stars, [&](const MeshFace& face) {
    for (std::size_t i = 1; i < face.sides.size(); ++i) {
      const std::uint32_t a = face.sides[i - 1].tet;
      const std::uint32_t b = face.sides[i].tet;
      if (class_of_tet(stars, exterior, a) == class_of_tet(stars, exterior, b)) sets.unite(a, b);
    }
  });
  for (std::uint32_t tet = 0; tet < tets; ++tet) {
    if (stars.leaves_out(tet)) sets.unite(tet, static_cast<std::uint32_t>(tets));
  }
  return number_parts(std::move(sets), std::size_t{exterior} + 2, [&](std::size_t member) {
    const auto tet = static_cast<std::uint32_t>(member);
    return member == tets || stars.leaves_out(tet) ? exterior : class_of_tet(stars, exterior, tet);
  });
}

EdgeWalk::EdgeWalk(const MeshStars& stars, Label exterior)
    : stars_(stars), exterior_(exterior), on_exterior_(stars.vertex_count()) {
  visit_whole_faces(stars, [&](const MeshFace& face) {
    if (face.sides.size() != 1) return;
    const auto& v = face.vertices;
    for (const std::uint32_t vertex : v) on_exterior_[vertex] = true;
    for (const auto& [a, b] : {std::pair{v[0], v[1]}, {v[0], v[2]}, {v[1], v[2]}}) {
      exterior_edges_.push_back(std::uint64_t{a} << 32 | b);
    }
  });
  sort_distinct(exterior_edges_);
}

void EdgeWalk::collect(std::uint32_t v) {
  edges_.clear();
  for (const std::uint32_t tet : stars_.star(v)) {
    for (const std::uint64_t other : stars_.mesh().tets[tet]) {
      if (other > v) edges_.push_back(other << 32 | class_of_tet(stars_, exterior_, tet));
    }
  }
  for (; next_ < exterior_edges_.size() && exterior_edges_[next_] >> 32 <= v; ++next_) {
    const std::uint64_t edge = exterior_edges_[next_];
    if (edge >> 32 == v) edges_.push_back(edge << 32 | exterior_);
  }
  std::sort(edges_.begin(), edges_.end());
}

}  // namespace mw::audit
