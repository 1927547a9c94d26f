// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Places of a mesh: every vertex, edge and triangle once, with all labels around it.
#include <algorithm>
#include <utility>

#include "kernels/audit/mesh_parts.h"
#include "kernels/audit/place_counter.h"

namespace mw::audit {
namespace {

/// b2 of all interfaces.
Cavities cavities_of(const MeshStars& stars, Label exterior) {
  const Parts parts = parts_of_mesh(stars, exterior);
  PairSet pairs;
  visit_faces(stars, [&](const MeshFace& face) {
    std::uint32_t previous =
        face.sides.size() == 1 ? parts.of_member.back() : parts.of_member[face.sides[0].tet];
    for (const FaceSide& side : face.sides) {
      pairs.add(previous, parts.of_member[side.tet]);
      previous = parts.of_member[side.tet];
    }
  });
  return cavities_of_interfaces(parts.part_class, pairs.take());
}

class MeshPlaceSweep {
 public:
  MeshPlaceSweep(const MeshStars& stars, Label exterior)
      : stars_(stars), exterior_(exterior), box_(box_cells(stars)), sweep_(stars.vertex_count()) {}

  Places run(const Cavities& cavities) {
    for (std::uint32_t v = 0; v < stars_.vertex_count(); ++v) {
      add_vertex(v);
      add_edges(v);
      visit_faces_at(stars_, v, sides_, [this](const MeshFace& face) { add_face(face); });
    }
    return sweep_.take(cavities);
  }

 private:
  [[nodiscard]] Label class_of(std::uint32_t tet) const {
    return class_of_tet(stars_, exterior_, tet);
  }

  [[nodiscard]] std::span<const Label> distinct_labels() {
    std::sort(labels_.begin(), labels_.end());
    labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
    return labels_;
  }

  void add_vertex(std::uint32_t v) {
    labels_.clear();
    if (box_.vertices[v]) labels_.push_back(exterior_);
    for (const std::uint32_t tet : stars_.star(v)) labels_.push_back(class_of(tet));
    sweep_.add_vertex(distinct_labels(), v);
  }

  /// Edges from v to a larger vertex; those of the box are read along, as v ascends.
  void add_edges(std::uint32_t v) {
    edges_.clear();
    for (const std::uint32_t tet : stars_.star(v)) {
      for (const std::uint64_t other : stars_.mesh().tets[tet]) {
        if (other > v) edges_.push_back({other, class_of(tet)});
      }
    }
    for (; next_box_edge_ < box_.edges.size() && box_.edges[next_box_edge_] >> 32 == v;
         ++next_box_edge_) {
      edges_.push_back({box_.edges[next_box_edge_] & 0xffffffffU, exterior_});
    }
    std::sort(edges_.begin(), edges_.end());
    for (std::size_t i = 0; i < edges_.size();) {
      const std::uint64_t other = edges_[i].first;
      labels_.clear();
      for (; i < edges_.size() && edges_[i].first == other; ++i) {
        labels_.push_back(edges_[i].second);
      }
      sweep_.add_edge(distinct_labels(), v, other);
    }
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
  BoxCells box_;
  PlaceSweep sweep_;
  std::size_t next_box_edge_ = 0;
  std::vector<FaceSide> sides_;
  std::vector<Label> labels_;
  std::vector<std::pair<std::uint64_t, Label>> edges_;
};

}  // namespace

Places mesh_places(const AuditMesh& mesh, std::size_t label_count) {
  const MeshStars stars(mesh);
  const auto exterior = static_cast<Label>(label_count);
  return MeshPlaceSweep(stars, exterior).run(cavities_of(stars, exterior));
}

}  // namespace mw::audit
