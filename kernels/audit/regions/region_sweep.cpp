// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells, parts and boundaries of every label in one walk over the vertices.
#include <algorithm>
#include <utility>

#include "kernels/audit/regions/region_sets.h"
#include "kernels/core/sort_distinct.h"

namespace mw::audit {
namespace {

class RegionSweep {
 public:
  RegionSweep(const MeshStars& stars, std::size_t label_count)
      : stars_(stars),
        exterior_(static_cast<Label>(label_count)),
        sets_(stars, exterior_),
        tallies_(label_count) {}

  RegionsPiece run() {
    for (std::uint32_t v = 0; v < stars_.vertex_count(); ++v) {
      if (!stars_.owns(v)) continue;
      take_labels(v);
      count_vertex();
      count_edges(v);
      join_parts();
      join_boundaries(v);
      join_clusters(v);
      visit_faces_at(stars_, v, scratch_, [this](const MeshFace& face) { count_face(face); });
    }
    count_tets();
    return sets_.conclude(std::move(tallies_));
  }

 private:
  /// An edge from the current vertex, by its other end, and a label that has it.
  using LabelledEdge = std::pair<std::uint64_t, Label>;
  struct EdgeSide {
    LabelledEdge edge;
    std::uint32_t side = 0;
    friend auto operator<=>(const EdgeSide&, const EdgeSide&) = default;
  };

  [[nodiscard]] Label class_of(std::uint32_t tet) const { return sets_.class_of(tet); }
  [[nodiscard]] const RegionSide& side(std::uint32_t id) const { return sets_.sides()[id]; }
  [[nodiscard]] const Position& at(std::uint64_t v) const { return stars_.mesh().vertices[v]; }

  /// Adds a cell in the closure of a label; inside says that it is in the interior too.
  void add(Label label, std::int64_t sign, bool inside) {
    if (label >= exterior_) return;
    tallies_[label].closed += sign;
    if (inside) tallies_[label].only += sign;
  }

  /// Collects the tets and boundary triangles at v, each sorted by label.
  void take_labels(std::uint32_t v) {
    tets_.clear();
    for (const std::uint32_t tet : stars_.star(v)) {
      if (class_of(tet) < exterior_) tets_.emplace_back(class_of(tet), tet);
    }
    std::sort(tets_.begin(), tets_.end());
    rims_.clear();
    for (const std::uint32_t rim : sets_.sides().at(v)) {
      rims_.emplace_back(sets_.class_of_side(rim), rim);
    }
    std::sort(rims_.begin(), rims_.end());
  }

  /// Calls visit(label, its tets, its boundary triangles) for each label at the vertex.
  template <class Visit>
  void each_label(Visit visit) const {
    const auto by_label = [](const auto& entry, Label label) { return entry.first < label; };
    for (std::size_t begin = 0, end = 0; begin < tets_.size(); begin = end) {
      const Label label = tets_[begin].first;
      while (end < tets_.size() && tets_[end].first == label) ++end;
      const auto lo = std::lower_bound(rims_.begin(), rims_.end(), label, by_label);
      const auto hi = std::lower_bound(lo, rims_.end(), label + 1, by_label);
      visit(label, std::span(tets_).subspan(begin, end - begin), std::span(lo, hi));
    }
  }

  void count_vertex() {
    each_label([&](Label label, const auto&, const auto& rims) { add(label, 1, rims.empty()); });
  }

  /// Counts the edges from v to larger vertices, and takes the turns around those of boundaries.
  void count_edges(std::uint32_t v) {
    edges_.clear();
    for (const auto& [label, tet] : tets_) {
      for (const std::uint64_t other : stars_.mesh().tets[tet]) {
        if (other > v) edges_.push_back({other, label});
      }
    }
    sort_distinct(edges_);
    rim_edges_.clear();
    for (const auto& [label, rim] : rims_) {
      for (const std::uint64_t other : side(rim).vertices) {
        if (other > v) rim_edges_.push_back({{other, label}, rim});
      }
    }
    std::sort(rim_edges_.begin(), rim_edges_.end());
    auto rim = rim_edges_.begin();
    for (const LabelledEdge& edge : edges_) {
      wings_.clear();
      for (; rim != rim_edges_.end() && rim->edge == edge; ++rim) {
        wings_.push_back(wing(rim->side, v, edge.first));
      }
      add(edge.second, -1, wings_.empty());
      if (wings_.empty()) continue;
      unite_around_edge(at(v), at(edge.first), wings_, unite_without_);
    }
  }

  /// Returns a triangle as seen from its edge (v, other), or from vertex v when other is v.
  [[nodiscard]] BoundaryWing wing(std::uint32_t id, std::uint64_t v, std::uint64_t other) const {
    const auto& corners = side(id).vertices;
    const TetRow& tet = stars_.mesh().tets[side(id).tet];
    BoundaryWing out{.side = id};
    for (const std::uint32_t corner : corners) {
      if (corner == v || corner == other) continue;
      (out.p == nullptr ? out.p : out.q) = &at(corner);
    }
    out.apex = &at(tet[apex_of(tet, corners)]);
    return out;
  }

  /// Unites the parts of each label at the vertex, as closed regions meet in vertices.
  void join_parts() {
    each_label([&](Label, const auto& tets, const auto&) {
      const std::uint32_t first = sets_.part_of(tets.front().second);
      for (const auto& [label, tet] : tets) sets_.unite_parts(first, sets_.part_of(tet));
    });
  }

  /// Unites the boundary triangles of each part at v, as these also meet in vertices.
  void join_boundaries(std::uint32_t v) {
    part_rims_.clear();
    for (const auto& [label, rim] : rims_) part_rims_.emplace_back(sets_.part_of_side(rim), rim);
    std::sort(part_rims_.begin(), part_rims_.end());
    met_.clear();
    for (std::size_t i = 0; i < part_rims_.size(); ++i) {
      const auto& [part, rim] = part_rims_[i];
      const bool is_first = i == 0 || part_rims_[i - 1].first != part;
      if (!is_first) sets_.unite_within(part_rims_[i - 1].second, rim);
      if (is_first && sets_.is_open(part)) met_.push_back(rim);
    }
    note_meetings(v);
  }

  /// Parts of a label that meet here may turn out to be one; they follow each other in met_.
  void note_meetings(std::uint32_t v) {
    const auto same = [&](std::size_t a, std::size_t b) {
      return sets_.class_of_side(met_[a]) == sets_.class_of_side(met_[b]);
    };
    for (std::size_t i = 0; i < met_.size(); ++i) {
      if ((i > 0 && same(i - 1, i)) || (i + 1 < met_.size() && same(i, i + 1))) {
        sets_.add_meeting(v, met_[i]);
      }
    }
  }

  /// Unites boundaries across gaps between clusters of a label's tets that share only v.
  void join_clusters(std::uint32_t v) {
    each_label([&](Label, const auto& tets, const auto& rims) {
      if (rims.empty()) return;
      find_clusters(v, tets);
      if (cones_.size() < 2) return;
      wings_.clear();
      for (const auto& [label, rim] : rims) wings_.push_back(wing(rim, v, v));
      unite_around_vertex(at(v), wings_, cones_, unite_without_);
    });
  }

  /// Fills cones_ with a tet of each cluster.
  void find_clusters(std::uint32_t v, std::span<const std::pair<Label, std::uint32_t>> tets) {
    DisjointSets clusters(tets.size());
    corners_.clear();
    for (std::uint32_t i = 0; i < tets.size(); ++i) {
      for (const std::uint64_t corner : stars_.mesh().tets[tets[i].second]) {
        if (corner != v) corners_.emplace_back(corner, i);
      }
    }
    std::sort(corners_.begin(), corners_.end());
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      if (corners_[i].first != corners_[i - 1].first) continue;
      clusters.unite(corners_[i].second, corners_[i - 1].second);
    }
    cones_.clear();
    for (std::uint32_t i = 0; i < tets.size(); ++i) {
      if (clusters.find(i) == i) cones_.push_back(cone(v, tets[i].second));
    }
  }

  [[nodiscard]] Cone cone(std::uint32_t v, std::uint32_t tet) const {
    Cone out{};
    std::size_t count = 0;
    for (const std::uint64_t corner : stars_.mesh().tets[tet]) {
      if (corner != v) out[count++] = &at(corner);
    }
    return out;
  }

  void count_face(const MeshFace& face) {
    for (std::size_t i = 0; i < face.sides.size(); ++i) {
      const Label label = class_of(face.sides[i].tet);
      bool is_first = true, is_alone = true;
      for (std::size_t k = 0; k < face.sides.size(); ++k) {
        if (k == i || class_of(face.sides[k].tet) != label) continue;
        is_alone = false;
        is_first = is_first && i < k;
      }
      if (is_first) add(label, 1, !is_alone);
    }
  }

  void count_tets() {
    for (std::uint32_t tet = 0; tet < stars_.mesh().tets.size(); ++tet) {
      if (stars_.tile().owns_tet(tet) && !stars_.leaves_out(tet)) add(class_of(tet), -1, true);
    }
  }

  const MeshStars& stars_;
  Label exterior_;
  RegionSets sets_;
  std::vector<RegionTally> tallies_;  ///< by label
  UniteSides unite_without_ = [this](std::uint32_t a, std::uint32_t b) {
    sets_.unite_without(a, b);
  };
  std::vector<std::pair<Label, std::uint32_t>> tets_, rims_;  ///< by label, at the current vertex
  std::vector<LabelledEdge> edges_;
  std::vector<EdgeSide> rim_edges_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> part_rims_;  ///< by part
  std::vector<std::uint32_t> met_;                                  ///< a rim of each open part
  std::vector<BoundaryWing> wings_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> corners_;
  std::vector<Cone> cones_;
  std::vector<FaceSide> scratch_;
};

}  // namespace

RegionsPiece regions_of(const MeshStars& stars, std::size_t label_count) {
  return RegionSweep(stars, label_count).run();
}

}  // namespace mw::audit
