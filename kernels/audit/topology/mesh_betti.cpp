// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts and cells of a mesh: one sweep over triangles for the parts, one over vertices to count.
#include <algorithm>
#include <utility>

#include "kernels/audit/topology/mesh_parts.h"
#include "kernels/audit/topology/parts_union.h"
#include "kernels/core/sort_distinct.h"

namespace mw::audit {
namespace {

class MeshSweep {
 public:
  MeshSweep(const MeshStars& stars, std::size_t label_count)
      : stars_(stars),
        exterior_(static_cast<Label>(label_count)),
        euler_(label_count + 2),
        edges_(stars, exterior_) {
    join_parts();
  }

  MeshParts run() {
    for (std::uint32_t v = 0; v < stars_.vertex_count(); ++v) {
      if (!stars_.owns(v) || stars_.star(v).empty()) continue;
      count_vertex(v);
      edges_.visit(v, [this](std::uint64_t, const auto& classes) { euler_.add(-1, classes); });
      visit_faces_at(stars_, v, sides_, [this](const MeshFace& face) { count_face(face); });
    }
    count_cells();
    return {{std::move(part_class_), graph_.take_face_pairs(), graph_.take_vertex_pairs(),
             euler_.cells(), euler_.total},
            std::move(parts_)};
  }

 private:
  void join_parts() {
    Parts parts = parts_of_mesh(stars_, exterior_);
    parts_ = std::move(parts.of_member);
    part_class_ = std::move(parts.part_class);
    exterior_part_ = parts_.back();
  }

  void count_vertex(std::uint32_t v) {
    around_.clear();
    if (edges_.is_on_exterior(v)) around_.push_back(exterior_part_);
    for (const std::uint32_t tet : stars_.star(v)) around_.push_back(parts_[tet]);
    sort_distinct(around_);
    graph_.add_vertex(around_, part_class_);
    classes_.clear();
    for (const std::uint32_t part : around_) classes_.push_back(part_class_[part]);
    add_cell(1);
  }

  void count_face(const MeshFace& face) {
    classes_.clear();
    std::uint32_t previous = face.sides.size() == 1 ? exterior_part_ : parts_[face.sides[0].tet];
    if (face.sides.size() == 1) classes_.push_back(exterior_);
    for (const FaceSide& side : face.sides) {
      const std::uint32_t part = parts_[side.tet];
      graph_.add_face(previous, part);
      previous = part;
      classes_.push_back(part_class_[part]);
    }
    std::sort(classes_.begin(), classes_.end());
    add_cell(1);
  }

  void count_cells() {
    for (std::uint32_t tet = 0; tet < stars_.mesh().tets.size(); ++tet) {
      if (!stars_.leaves_out(tet) && stars_.tile().owns_tet(tet))
        euler_.add(-1, std::span(&part_class_[parts_[tet]], 1));
    }
  }

  /// Adds a cell that has classes_, which ascend, around it.
  void add_cell(std::int64_t sign) {
    classes_.erase(std::unique(classes_.begin(), classes_.end()), classes_.end());
    euler_.add(sign, classes_);
  }

  const MeshStars& stars_;
  Label exterior_;
  EulerSums euler_;
  PartGraph graph_;
  EdgeWalk edges_;
  std::vector<std::uint32_t> parts_;
  std::vector<Label> part_class_;
  std::uint32_t exterior_part_ = 0;
  std::vector<FaceSide> sides_;
  std::vector<std::uint32_t> around_;
  std::vector<Label> classes_;
};

}  // namespace

MeshParts mesh_parts(const MeshStars& stars, std::size_t label_count) {
  return MeshSweep(stars, label_count).run();
}

std::vector<RegionBetti> mesh_betti(const AuditMesh& mesh, std::size_t label_count) {
  PartsUnion parts(label_count);
  parts.add(mesh_parts(MeshStars(mesh), label_count).piece);
  return parts.betti_of_mesh();
}

}  // namespace mw::audit
