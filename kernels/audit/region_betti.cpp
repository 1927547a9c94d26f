// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells, parts and boundaries of every label in one walk over the vertices.
#include "kernels/audit/region_betti.h"

#include <algorithm>
#include <utility>

#include "kernels/audit/mesh_parts.h"
#include "kernels/audit/outer_turn.h"

namespace mw::audit {
namespace {

/// A triangle of a label's boundary: one tet of the label on it.
struct Side {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t tet = 0;
};

/// The boundary triangles of all labels, and those at each vertex.
class Sides {
 public:
  Sides(const MeshStars& stars, Label exterior) : begin_(stars.vertex_count() + 1) {
    visit_faces(stars, [&](const MeshFace& face) {
      for (const FaceSide& side : face.sides) {
        const Label label = class_of_tet(stars, exterior, side.tet);
        const auto same =
            std::count_if(face.sides.begin(), face.sides.end(), [&](const FaceSide& other) {
              return class_of_tet(stars, exterior, other.tet) == label;
            });
        if (same == 1 && label < exterior) all_.push_back({face.vertices, side.tet});
      }
    });
    for (const Side& side : all_) {
      for (const std::uint32_t v : side.vertices) ++begin_[v + 1];
    }
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    at_.resize(begin_.back());
    std::vector<std::uint64_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
      for (const std::uint32_t v : all_[i].vertices) at_[next[v]++] = i;
    }
  }

  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] const Side& operator[](std::uint32_t side) const { return all_[side]; }
  [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t vertex) const {
    return std::span(at_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
  }

 private:
  std::vector<Side> all_;
  std::vector<std::uint64_t> begin_;
  std::vector<std::uint32_t> at_;
};

class RegionSweep {
 public:
  RegionSweep(const AuditMesh& mesh, std::size_t label_count)
      : stars_(mesh),
        exterior_(static_cast<Label>(label_count)),
        sides_(stars_, exterior_),
        parts_(parts_of_mesh(stars_, exterior_)),
        touching_(parts_.part_class.size()),
        within_(sides_.size()),
        without_(sides_.size()),
        closed_(label_count),
        only_(label_count) {}

  std::vector<RegionBetti> run() {
    for (std::uint32_t v = 0; v < stars_.vertex_count(); ++v) {
      take_labels(v);
      count_vertex(v);
      count_edges(v);
      join_parts_and_boundaries(v);
      join_clusters(v);
      visit_faces_at(stars_, v, scratch_, [this](const MeshFace& face) { count_face(face); });
    }
    for (std::uint32_t tet = 0; tet < stars_.mesh().tets.size(); ++tet) {
      if (!MeshStars::repeats_vertex(stars_.mesh().tets[tet])) add(class_of(tet), -1, true);
    }
    return conclude();
  }

 private:
  /// An edge from a vertex, as a label or one of its boundary triangles has it.
  using LabelledEdge = std::pair<std::uint64_t, Label>;
  struct EdgeSide {
    LabelledEdge edge;
    std::uint32_t side = 0;
    friend auto operator<=>(const EdgeSide&, const EdgeSide&) = default;
  };

  [[nodiscard]] Label class_of(std::uint32_t tet) const {
    return class_of_tet(stars_, exterior_, tet);
  }
  [[nodiscard]] Label class_of_side(std::uint32_t side) const { return class_of(sides_[side].tet); }
  [[nodiscard]] const Position& at(std::uint64_t v) const { return stars_.mesh().vertices[v]; }

  /// One cell in the closure of a label; inside: of its interior too.
  void add(Label label, std::int64_t sign, bool inside) {
    if (label >= exterior_) return;
    closed_[label] += sign;
    if (inside) only_[label] += sign;
  }

  /// Tets and boundary triangles at v, each by label.
  void take_labels(std::uint32_t v) {
    tets_.clear();
    for (const std::uint32_t tet : stars_.star(v)) {
      if (class_of(tet) < exterior_) tets_.emplace_back(class_of(tet), tet);
    }
    std::sort(tets_.begin(), tets_.end());
    rims_.clear();
    for (const std::uint32_t side : sides_.at(v)) rims_.emplace_back(class_of_side(side), side);
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

  void count_vertex(std::uint32_t) {
    each_label([&](Label label, const auto&, const auto& rims) { add(label, 1, rims.empty()); });
  }

  /// Edges from v to a larger vertex, and the turns around those of boundaries.
  void count_edges(std::uint32_t v) {
    edges_.clear();
    for (const auto& [label, tet] : tets_) {
      for (const std::uint64_t other : stars_.mesh().tets[tet]) {
        if (other > v) edges_.push_back({other, label});
      }
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    rim_edges_.clear();
    for (const auto& [label, side] : rims_) {
      for (const std::uint64_t other : sides_[side].vertices) {
        if (other > v) rim_edges_.push_back({{other, label}, side});
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

  /// other: v itself for all of the triangle but v.
  [[nodiscard]] BoundaryWing wing(std::uint32_t id, std::uint64_t v, std::uint64_t other) const {
    const Side& side = sides_[id];
    BoundaryWing out{.side = id};
    for (const std::uint32_t corner : side.vertices) {
      if (corner == v || corner == other) continue;
      (out.p == nullptr ? out.p : out.q) = &at(corner);
    }
    for (const std::uint64_t corner : stars_.mesh().tets[side.tet]) {
      if (std::find(side.vertices.begin(), side.vertices.end(), corner) == side.vertices.end()) {
        out.apex = &at(corner);
      }
    }
    return out;
  }

  /// Closed regions meet in vertices, and so do the boundaries of a part.
  void join_parts_and_boundaries(std::uint32_t) {
    each_label([&](Label, const auto& tets, const auto& rims) {
      const std::uint32_t first = parts_.of_member[tets.front().second];
      for (const auto& [label, tet] : tets) touching_.unite(first, parts_.of_member[tet]);
      for (std::size_t i = 0; i < rims.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
          if (part_of(rims[i].second) != part_of(rims[k].second)) continue;
          within_.unite(rims[i].second, rims[k].second);
          break;
        }
      }
    });
  }
  [[nodiscard]] std::uint32_t part_of(std::uint32_t side) const {
    return parts_.of_member[sides_[side].tet];
  }

  /// Gaps between clusters of a label's tets that share nothing but v.
  void join_clusters(std::uint32_t v) {
    each_label([&](Label, const auto& tets, const auto& rims) {
      if (rims.empty()) return;
      find_clusters(v, tets);
      if (cones_.size() < 2) return;
      wings_.clear();
      for (const auto& [label, side] : rims) wings_.push_back(wing(side, v, v));
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

  /// How many sets there are of each label.
  template <class LabelOf>
  [[nodiscard]] std::vector<std::int64_t> sets_by_label(DisjointSets& sets, std::size_t count,
                                                        LabelOf label_of) const {
    std::vector<std::int64_t> out(std::size_t{exterior_} + 2);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (sets.find(i) == i) ++out[label_of(i)];
    }
    return out;
  }

  std::vector<RegionBetti> conclude() {
    const auto class_of_part = [&](std::uint32_t part) { return parts_.part_class[part]; };
    const auto class_of_rim = [&](std::uint32_t side) { return class_of_side(side); };
    const auto regions = sets_by_label(touching_, parts_.part_class.size(), class_of_part);
    const auto inner = sets_by_label(within_, sides_.size(), class_of_rim);
    const auto outer = sets_by_label(without_, sides_.size(), class_of_rim);
    std::vector<std::int64_t> parts(std::size_t{exterior_} + 2);
    for (const Label label : parts_.part_class) ++parts[label];
    std::vector<RegionBetti> out(exterior_);
    for (Label l = 0; l < exterior_; ++l) {
      if (parts[l] == 0) continue;
      const std::int64_t hollows = outer[l] - regions[l], holes = inner[l] - parts[l];
      out[l].closed = {regions[l], regions[l] + hollows - closed_[l], hollows};
      // The Euler characteristic of an open set in three dimensions is less the sum over its cells.
      out[l].open = {parts[l], parts[l] + holes + only_[l], holes};
    }
    return out;
  }

  MeshStars stars_;
  Label exterior_;
  Sides sides_;
  Parts parts_;
  DisjointSets touching_;  ///< parts
  DisjointSets within_;    ///< boundary triangles of a part, seen from the part
  DisjointSets without_;   ///< boundary triangles of a label, seen from outside
  UniteSides unite_without_ = [this](std::uint32_t a, std::uint32_t b) { without_.unite(a, b); };
  std::vector<std::int64_t> closed_, only_;                   ///< sums over cells, by label
  std::vector<std::pair<Label, std::uint32_t>> tets_, rims_;  ///< at the vertex, as are the others
  std::vector<LabelledEdge> edges_;
  std::vector<EdgeSide> rim_edges_;
  std::vector<BoundaryWing> wings_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> corners_;
  std::vector<Cone> cones_;
  std::vector<FaceSide> scratch_;
};

}  // namespace

std::vector<RegionBetti> region_betti(const AuditMesh& mesh, std::size_t label_count) {
  return RegionSweep(mesh, label_count).run();
}

}  // namespace mw::audit
