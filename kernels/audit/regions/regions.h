// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Betti numbers of labels in a mesh that has gaps, from what tiles see of it, each for itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/topology/betti.h"
#include "kernels/core/disjoint_sets.h"

namespace mw::audit {

/// Connected sets that are counted for each label; see region_betti().
enum class RegionKind : std::uint8_t {
  kPart,    ///< tets that meet in triangles
  kRegion,  ///< parts that meet in vertices
  kInner,   ///< boundary triangles of a part, as the part sees them
  kOuter,   ///< boundary triangles of a region, as they are seen from outside
};
inline constexpr std::size_t kRegionKinds = 4;

/// Counts of the sets of each kind and of the cells of one label.
struct RegionTally {
  Label label = 0;
  std::array<std::int64_t, kRegionKinds> sets{};
  std::int64_t closed = 0;  ///< sum over the cells in the label's closure, see EulerSums
  std::int64_t only = 0;    ///< sum over the cells inside of it
};

/// A set that may go on in other tiles.
struct OpenSet {
  Label label = 0;
  RegionKind kind = RegionKind::kPart;
};

/// What one tile tells, its open sets numbered from 0.
struct RegionsPiece {
  struct Item {
    std::uint64_t item = 0;  ///< the same tet or triangle in every tile
    std::uint32_t set = 0;
  };
  /// An inner boundary at a vertex where its part meets another of the same label: when it turns
  /// out that they are one part, their boundaries are one as well.
  struct Meeting {
    std::uint64_t vertex = 0;  ///< its id in the whole mesh
    std::uint32_t part = 0;
    std::uint32_t inner = 0;
  };

  std::vector<RegionTally> tallies;  ///< ascending by label; open sets are counted too
  std::vector<OpenSet> open;
  std::vector<Item> shared;  ///< sets with the same item are one
  std::vector<Meeting> meetings;
};

/// REQUIRES, errors and cost: as region_betti.
[[nodiscard]] RegionsPiece regions_of(const MeshStars& stars, std::size_t label_count);

/// Joins the pieces of all tiles.  Memory: 12 bytes an open set.
class RegionsUnion {
 public:
  explicit RegionsUnion(std::size_t label_count) : tallies_(label_count) {}

  /// Takes tallies and open sets, whose labels are those of the whole.  Returns the number of the
  /// piece's open set 0; the others follow.  ERRORS: kResource from 2^32 - 1 open sets on.
  std::uint32_t add(const RegionsPiece& piece);
  /// Makes two open sets, numbered through all pieces, one.  REQUIRES: all pieces were added; the
  /// sets are of one kind and label.
  void unite(std::uint32_t a, std::uint32_t b);
  /// Takes all meetings at one vertex, numbered through all pieces; leaves them in another order.
  /// REQUIRES: all parts that have an item in common were united.
  void meet(std::span<RegionsPiece::Meeting> meetings);

  /// Returns the Betti numbers by label.
  [[nodiscard]] std::vector<RegionBetti> betti() const;

 private:
  DisjointSets& sets();

  std::vector<RegionTally> tallies_;  ///< by label
  std::vector<OpenSet> open_;
  std::optional<DisjointSets> sets_;
};

/// Counts what mesh_betti() does, without its last row (the exterior) and without asking what is
/// outside of a label's tets: other labels, the exterior, or space without tets (labels that were
/// left out).  Components and Euler characteristics are counted.  Cavities follow from boundaries,
/// because in the 3-sphere
///   the complement of a part (open, connected) has as many components as the part's boundary;
///   the complement of a connected closed region has as many as there are boundaries seen from
///   outside, where triangles follow each other around an edge, and across a vertex in one gap
///   between parts that meet there only.
/// Which triangles follow each other where a label meets itself in an edge or a vertex only is
/// decided by positions, with exact signs.
/// REQUIRES and errors: as mesh_betti.  Indicative only when tets overlap.
/// Cost: O(T) plus small sorts a vertex star; 20 bytes a tet, 60 a triangle between labels.
[[nodiscard]] std::vector<RegionBetti> region_betti(const AuditMesh& mesh, std::size_t label_count);

}  // namespace mw::audit
