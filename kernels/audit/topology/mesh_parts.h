// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The face-connected parts of all labels of a mesh, and what touches the exterior.
#pragma once

#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/topology/part_graph.h"

namespace mw::audit {

/// Class of a tet: a label of the volume (they are below `exterior`), or exterior + 1 for all
/// labels that are not the volume's.
[[nodiscard]] inline Label class_of_tet(const MeshStars& stars, Label exterior, std::uint32_t tet) {
  const Label label = stars.mesh().labels[tet];
  return label < exterior ? label : exterior + 1;
}

/// Parts of a tile's tets by class.  Member tet_count is the exterior; tets that name a vertex
/// twice are counted to it.  Cost: one sort of the triangles at each vertex.
[[nodiscard]] Parts parts_of_mesh(const MeshStars& stars, Label exterior);

/// The edges of a tile's vertices, with all classes around each, and what is on the exterior: the
/// corners and edges of triangles that have one tet and an owned vertex.
class EdgeWalk {
 public:
  /// Reads the stars as long as it lives.  Cost: as parts_of_mesh.
  EdgeWalk(const MeshStars& stars, Label exterior);

  [[nodiscard]] bool is_on_exterior(std::uint32_t vertex) const { return on_exterior_[vertex]; }

  /// Calls visit(other, classes) for each edge from v to a larger vertex, ascending; classes ascend
  /// and are distinct.  REQUIRES: v is larger than in the call before.
  template <class Visit>
  void visit(std::uint32_t v, Visit&& visit) {
    collect(v);
    for (std::size_t i = 0; i < edges_.size();) {
      const std::uint64_t other = edges_[i] >> 32;
      classes_.clear();
      for (; i < edges_.size() && edges_[i] >> 32 == other; ++i) {
        const auto next = static_cast<Label>(edges_[i] & 0xffffffffU);
        if (classes_.empty() || classes_.back() != next) classes_.push_back(next);
      }
      visit(other, std::span<const Label>(classes_));
    }
  }

 private:
  void collect(std::uint32_t v);

  const MeshStars& stars_;
  Label exterior_;
  std::vector<bool> on_exterior_;              ///< by vertex
  std::vector<std::uint64_t> exterior_edges_;  ///< ascending, smaller vertex in the high half
  std::size_t next_ = 0;                       ///< the first of these that was not yet met
  std::vector<std::uint64_t> edges_;           ///< larger vertex in the high half, class in the low
  std::vector<Label> classes_;
};

}  // namespace mw::audit
