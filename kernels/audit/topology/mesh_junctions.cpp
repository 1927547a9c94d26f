// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Junctions of a mesh: every vertex, edge and triangle with all labels around it.
#include "kernels/audit/topology/junction_counter.h"
#include "kernels/audit/topology/mesh_parts.h"
#include "kernels/core/sort_distinct.h"

namespace mw::audit {
namespace {

/// A vertex is shared with other tiles if one of them owns it, or a vertex of one of its tets.
JunctionVertices vertices_of(const MeshStars& stars) {
  JunctionVertices out;
  for (std::uint32_t v = 0; v < stars.vertex_count(); ++v) {
    out.owned.push_back(stars.owns(v));
    out.shared.push_back(!stars.owns(v));
    out.ids.push_back(stars.tile().vertex_id(v));
  }
  for (std::size_t t = 0; t < stars.mesh().tets.size(); ++t) {
    if (!stars.tile().is_shared(t)) continue;
    for (const std::uint64_t v : stars.mesh().tets[t]) out.shared[v] = true;
  }
  return out;
}

class MeshJunctionSweep {
 public:
  MeshJunctionSweep(const MeshStars& stars, Label exterior)
      : stars_(stars), exterior_(exterior), edges_(stars, exterior), sweep_(vertices_of(stars)) {}

  JunctionsPiece run() {
    for (std::uint32_t v = 0; v < stars_.vertex_count(); ++v) {
      if (!stars_.owns(v)) continue;
      add_vertex(v);
      edges_.visit(
          v, [&](std::uint64_t other, const auto& classes) { sweep_.add_edge(classes, v, other); });
    }
    visit_whole_faces(stars_, [this](const MeshFace& face) { add_face(face); });
    return sweep_.take();
  }

 private:
  [[nodiscard]] Label class_of(std::uint32_t tet) const {
    return class_of_tet(stars_, exterior_, tet);
  }

  [[nodiscard]] std::span<const Label> distinct_labels() {
    sort_distinct(labels_);
    return labels_;
  }

  void add_vertex(std::uint32_t v) {
    labels_.clear();
    if (edges_.is_on_exterior(v)) labels_.push_back(exterior_);
    for (const std::uint32_t tet : stars_.star(v)) labels_.push_back(class_of(tet));
    sweep_.add_vertex(distinct_labels(), v);
  }

  void add_face(const MeshFace& face) {
    labels_.clear();
    if (face.sides.size() == 1) labels_.push_back(exterior_);
    for (const FaceSide& side : face.sides) labels_.push_back(class_of(side.tet));
    const auto& v = face.vertices;
    sweep_.add_face(distinct_labels(), std::array<std::uint64_t, 3>{v[0], v[1], v[2]});
  }

  const MeshStars& stars_;
  Label exterior_;
  EdgeWalk edges_;
  JunctionSweep sweep_;
  std::vector<Label> labels_;
};

}  // namespace

JunctionsPiece mesh_junctions(const MeshStars& stars, std::size_t label_count) {
  return MeshJunctionSweep(stars, static_cast<Label>(label_count)).run();
}

}  // namespace mw::audit
