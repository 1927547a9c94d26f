// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts, regions and boundaries of all labels of a tile, while they grow together, and which of the
// triangles around an edge or a vertex bound the same gap.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/regions/regions.h"
#include "kernels/audit/subject.h"
#include "kernels/audit/topology/mesh_parts.h"

namespace mw::audit {

/// A triangle of a label's boundary, with the one tet of the label on it.
struct RegionSide {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t tet = 0;
};

/// The boundary triangles with a vertex that the tile owns, and which of them are at each vertex.
class RegionSides {
 public:
  /// Only labels below `exterior` are looked at.  Cost: one sort of the triangles at each vertex.
  RegionSides(const MeshStars& stars, Label exterior);

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(all_.size()); }
  [[nodiscard]] const RegionSide& operator[](std::uint32_t side) const { return all_[side]; }
  [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t vertex) const {
    return std::span(at_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
  }

 private:
  void sort_by_vertex();

  std::vector<RegionSide> all_;
  std::vector<std::uint64_t> begin_;
  std::vector<std::uint32_t> at_;
};

/// Sets of each RegionKind; parts are complete from the beginning.
/// Memory: 8 bytes a tet and 40 a triangle between labels.  Reads stars as long as it lives.
class RegionSets {
 public:
  RegionSets(const MeshStars& stars, Label exterior);

  [[nodiscard]] const RegionSides& sides() const { return sides_; }
  [[nodiscard]] Label class_of(std::uint32_t tet) const {
    return class_of_tet(stars_, exterior_, tet);
  }
  [[nodiscard]] Label class_of_side(std::uint32_t side) const { return class_of(sides_[side].tet); }
  [[nodiscard]] Label class_of_part(std::uint32_t part) const { return parts_.part_class[part]; }
  [[nodiscard]] std::uint32_t part_of(std::uint32_t tet) const { return parts_.of_member[tet]; }
  [[nodiscard]] std::uint32_t part_of_side(std::uint32_t side) const {
    return part_of(sides_[side].tet);
  }
  /// True if another tile has a tet of the part.
  [[nodiscard]] bool is_open(std::uint32_t part) const { return open_parts_[part]; }

  /// Unites two parts that meet in a vertex.
  void unite_parts(std::uint32_t a, std::uint32_t b) { touching_.unite(a, b); }
  /// Unites two boundary triangles of a part, as the part sees them.
  void unite_within(std::uint32_t a, std::uint32_t b) { within_.unite(a, b); }
  /// Unites two boundary triangles of a label, as they are seen from outside.
  void unite_without(std::uint32_t a, std::uint32_t b) { without_.unite(a, b); }
  /// Notes a side and its part at a vertex that the tile owns, where the label has another part.
  void add_meeting(std::uint32_t vertex, std::uint32_t side) {
    meetings_.push_back({stars_.tile().vertex_id(vertex), part_of_side(side), side});
  }

  /// Counts sets into the tallies (by label), which are moved to the piece.  REQUIRES: called once.
  [[nodiscard]] RegionsPiece conclude(std::vector<RegionTally> tallies);

 private:
  using Numbers = std::vector<std::uint32_t>;  ///< numbers of open sets, by root

  [[nodiscard]] bool is_shared(std::uint32_t tet) const;
  [[nodiscard]] bool is_shared_side(std::uint32_t side) const;
  template <class LabelOf>
  Numbers number(RegionKind kind, DisjointSets& sets, const std::vector<bool>& is_open,
                 LabelOf label_of);
  Numbers number_parts_and_regions();
  void number_boundaries(const Numbers& parts);
  void take_tallies();
  void share(std::uint32_t tet, unsigned which, std::uint32_t set);

  const MeshStars& stars_;
  Label exterior_;
  RegionSides sides_;
  Parts parts_;
  std::vector<bool> open_parts_;
  DisjointSets touching_;  ///< sets of parts
  DisjointSets within_;    ///< boundary triangles of a part, seen from the part
  DisjointSets without_;   ///< boundary triangles of a label, seen from outside
  std::vector<RegionsPiece::Meeting> meetings_;
  std::vector<RegionTally> tallies_;
  RegionsPiece out_;
};

/// A triangle of a region's boundary, seen from one of its edges or vertices.
struct BoundaryWing {
  std::uint32_t side = 0;          ///< number of the triangle
  const Position* p = nullptr;     ///< at an edge its third vertex, at a vertex its second
  const Position* q = nullptr;     ///< at a vertex its third
  const Position* apex = nullptr;  ///< apex of the region's tet on it
};

using UniteSides = std::function<void(std::uint32_t, std::uint32_t)>;

/// Unites those triangles at edge (a, b) between which a turn around the edge leads from one to the
/// other outside of the region.  Leaves wings in another order.
void unite_around_edge(const Position& a, const Position& b, std::vector<BoundaryWing>& wings,
                       const UniteSides& unite);

/// A tet of a region at a vertex, by its three other corners.
using Cone = std::array<const Position*, 3>;

/// Unites triangles at vertex v, where the region falls into several clusters that share only v;
/// cones has a tet of each.  Triangles of different clusters bound the same gap between them when
/// they follow each other on a way from one cluster to another.
void unite_around_vertex(const Position& v, std::span<const BoundaryWing> wings,
                         std::span<const Cone> cones, const UniteSides& unite);

}  // namespace mw::audit
