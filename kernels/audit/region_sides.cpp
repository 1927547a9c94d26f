// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One sweep over triangles, then a list by vertex.
#include "kernels/audit/region_sides.h"

#include "kernels/audit/mesh_parts.h"

namespace mw::audit {

RegionSides::RegionSides(const MeshStars& stars, Label exterior)
    : begin_(std::size_t{stars.vertex_count()} + 1) {
  visit_whole_faces(stars, [&](const MeshFace& face) {
    for (const FaceSide& side : face.sides) {
      const Label label = class_of_tet(stars, exterior, side.tet);
      const auto same = std::count_if(
          face.sides.begin(), face.sides.end(),
          [&](const FaceSide& other) { return class_of_tet(stars, exterior, other.tet) == label; });
      if (same == 1 && label < exterior) all_.push_back({face.vertices, side.tet});
    }
  });
  sort_by_vertex();
}

void RegionSides::sort_by_vertex() {
  for (const RegionSide& side : all_) {
    for (const std::uint32_t v : side.vertices) ++begin_[v + 1];
  }
  for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
  at_.resize(begin_.back());
  std::vector<std::uint64_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t i = 0; i < size(); ++i) {
    for (const std::uint32_t v : all_[i].vertices) at_[next[v]++] = i;
  }
}

}  // namespace mw::audit
