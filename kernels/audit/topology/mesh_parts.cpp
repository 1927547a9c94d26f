// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts by union-find over the triangles.
#include "kernels/audit/topology/mesh_parts.h"

#include <algorithm>
#include <utility>

namespace mw::audit {

Parts parts_of_mesh(const MeshStars& stars, Label exterior) {
  const std::size_t tets = stars.mesh().tets.size();
  const auto is_left_out = [&](std::uint32_t tet) {
    return MeshStars::repeats_vertex(stars.mesh().tets[tet]);
  };
  DisjointSets sets(tets + 1);
  visit_whole_faces(stars, [&](const MeshFace& face) {
    for (std::size_t i = 1; i < face.sides.size(); ++i) {
      const std::uint32_t a = face.sides[i - 1].tet;
      const std::uint32_t b = face.sides[i].tet;
      if (class_of_tet(stars, exterior, a) == class_of_tet(stars, exterior, b)) sets.unite(a, b);
    }
  });
  for (std::uint32_t tet = 0; tet < tets; ++tet) {
    if (is_left_out(tet)) sets.unite(tet, static_cast<std::uint32_t>(tets));
  }
  return number_parts(std::move(sets), std::size_t{exterior} + 2, [&](std::size_t member) {
    const auto tet = static_cast<std::uint32_t>(member);
    return member == tets || is_left_out(tet) ? exterior : class_of_tet(stars, exterior, tet);
  });
}

BoxCells box_cells(const MeshStars& stars) {
  BoxCells out{std::vector<bool>(stars.vertex_count(), false), {}};
  visit_whole_faces(stars, [&](const MeshFace& face) {
    if (face.sides.size() != 1) return;
    const auto& v = face.vertices;
    for (const std::uint32_t vertex : v) out.vertices[vertex] = true;
    for (const auto& [a, b] : {std::pair{v[0], v[1]}, {v[0], v[2]}, {v[1], v[2]}}) {
      out.edges.push_back(std::uint64_t{a} << 32 | b);
    }
  });
  std::sort(out.edges.begin(), out.edges.end());
  out.edges.erase(std::unique(out.edges.begin(), out.edges.end()), out.edges.end());
  return out;
}

}  // namespace mw::audit
