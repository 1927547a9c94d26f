// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh as solvers take it: tets by label, facets by what they bound, and nodes in the middles of
// edges.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "io/file/scratch/scratch_file.h"
#include "io/labels/label_table.h"
#include "io/mesh/element.h"
#include "io/mesh/grouped/box_sides.h"
#include "io/mesh/mesh_record.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/scratch_mesh.h"
#include "kernels/core/tet_nodes.h"

namespace mw::io {

/// Numbers begin .. end - 1.
struct RowRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;

  [[nodiscard]] std::uint64_t size() const { return end - begin; }
};

/// Facets that bound the same: an interface of two labels, first < second by rank, or one side of
/// the box or the outer surface at one label (second is kExterior).
struct FacetGroup {
  Side side = Side::kInterface;
  Label first = 0;
  Label second = kExterior;
  RowRange facets;
};

/// A triangle of a facet group.
struct Facet {
  std::array<std::uint64_t, 3> rows{};  ///< its normal (by the right hand) points out of `first`
  std::uint64_t tet = 0;                ///< the tet of label `first`
  std::uint64_t opposite = 0;           ///< the corner of that tet that is not in it, 0 to 3
  // The tet and the corner of label `second`, for an interface.
  std::uint64_t second_tet = 0;
  std::uint64_t second_opposite = 0;
};

/// The wedges of one interface.
struct WedgeGroup {
  Label bottom = 0;  ///< the label under them, by rank
  Label top = 0;     ///< the label on top of them
  RowRange wedges;
};

/// A wedge of no thickness between the two sides of a facet of a split interface.  Corner i of the
/// bottom lies where corner i of the top lies; both are one row where the vertex was not doubled,
/// which is so for at most two corners.
struct Wedge {
  std::array<std::uint64_t, 3> bottom{};  ///< its normal points to the top
  std::array<std::uint64_t, 3> top{};
  std::uint64_t bottom_tet = 0;  ///< the tet that has the bottom for a facet
  std::uint64_t top_tet = 0;
};

/// The nodes of a tet, a facet or a wedge: its corners and, where tets have ten nodes, behind them
/// the middles of its edges.  A tet has its edges in the order of kTetEdges, and a facet has them
/// as 0 1, 1 2, 2 0.  A wedge has the corners of bottom and top, then the middles of the bottom's
/// edges and those of the top's.
class NodeRows {
 public:
  [[nodiscard]] const std::uint64_t* begin() const { return rows_.data(); }
  [[nodiscard]] const std::uint64_t* end() const { return rows_.data() + size_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  void add(std::span<const std::uint64_t> rows) {
    std::copy(rows.begin(), rows.end(), rows_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += rows.size();
  }

 private:
  std::array<std::uint64_t, 12> rows_{};
  std::size_t size_ = 0;
};

/// The groups of a mesh, ascending by side, first, second.  Like the rest of the mesh they wait in
/// a temporary file.  ERRORS: see ScratchFile.
class FacetGroups {
 public:
  class Iterator {
   public:
    using value_type = FacetGroup;
    using difference_type = std::ptrdiff_t;

    Iterator() = default;
    Iterator(const FacetGroups* groups, std::size_t at) : groups_(groups), at_(at) {}
    [[nodiscard]] FacetGroup operator*() const { return (*groups_)[at_]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) { return {groups_, at_++}; }
    [[nodiscard]] bool operator==(const Iterator& other) const { return at_ == other.at_; }

   private:
    const FacetGroups* groups_ = nullptr;
    std::size_t at_ = 0;
  };

  explicit FacetGroups(const std::filesystem::path& folder) : groups_(folder) {}

  void add(const FacetGroup& group) { groups_.append(group); }
  [[nodiscard]] std::size_t size() const { return groups_.size(); }
  /// REQUIRES: number < size().
  [[nodiscard]] FacetGroup operator[](std::size_t number) const { return groups_[number]; }
  [[nodiscard]] Iterator begin() const { return {this, 0}; }
  [[nodiscard]] Iterator end() const { return {this, size()}; }

 private:
  mutable PagedFile<FacetGroup> groups_;  ///< reading fills its pages
};

/// A view of a mesh in temporary files, with lists of its own there, so that memory (8 MiB for each
/// list that is looked into) does not grow with the mesh.  The first rows of nodes are the vertices
/// as they came, the next ones the middles of edges, which ascend by their ends.  GroupedSink makes
/// the mesh, which can be asked in any order and is fastest in row order.
/// ERRORS (all members that look something up): see ScratchFile.  Thread safety: none.
class GroupedMesh {
 public:
  /// Returns the header that the mesh came with.
  [[nodiscard]] const MeshHeader& header() const { return header_; }
  /// Returns the labels that occur, ascending; groups hold their ranks.
  [[nodiscard]] const LabelTable& table() const { return table_; }
  [[nodiscard]] const LabelNames& names() const { return header_.names; }
  /// Returns the box of the record; if it has none, that of the vertices along the world's axes.
  [[nodiscard]] const MeshBox& box() const { return box_; }
  [[nodiscard]] Element element() const { return element_; }
  /// Returns the folder of the temporary files.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Returns the largest coordinate of a vertex, without its sign.
  [[nodiscard]] double largest_coordinate() const { return largest_coordinate_; }
  /// Returns the length of the shortest edge of a tet that has one, infinity if there is none.
  [[nodiscard]] double shortest_edge() const { return std::sqrt(shortest_square_); }
  /// Returns six times the volume of the smallest straight tet, infinity if there is no tet.
  [[nodiscard]] double least_volume6() const { return least_volume6_; }

  /// Return the number of vertices, and of nodes: where tets have middles each edge adds one.
  [[nodiscard]] std::uint64_t vertex_count() const { return source_->vertex_count(); }
  [[nodiscard]] std::uint64_t node_count() const { return vertex_count() + edges_.size(); }
  /// Returns the position of a node.  REQUIRES: row < node_count().
  [[nodiscard]] Position node(std::uint64_t row);

  /// Tets are numbered by label, and in a label as they came.  Corners are VTK-positive: the normal
  /// of the first three points at the fourth.  (Those of a flat tet are as they came.)
  [[nodiscard]] std::uint64_t tet_count() const { return tets_.size(); }
  [[nodiscard]] TetRows tet(std::uint64_t number) { return tets_.get(number); }
  /// Returns the numbers of each label's tets, by rank of label.
  [[nodiscard]] const std::vector<RowRange>& label_tets() const { return label_tets_; }
  [[nodiscard]] Label label_of(std::uint64_t tet) const;
  /// Returns the rows of the middles of kTetEdges.  REQUIRES: has_middles(element()).
  [[nodiscard]] std::array<std::uint64_t, 6> middles(std::uint64_t tet) { return middles_[tet]; }
  [[nodiscard]] NodeRows tet_nodes(std::uint64_t number);
  /// Returns the tet's number under the name header().values[column].
  [[nodiscard]] double value(std::uint64_t tet, std::size_t column) {
    return values_.get(tet * header_.values.size() + column);
  }

  [[nodiscard]] const FacetGroups& facet_groups() const { return facet_groups_; }
  [[nodiscard]] std::uint64_t facet_count() const { return facets_.size(); }
  /// Facets are numbered by group, and in a group by tet.
  [[nodiscard]] Facet facet(std::uint64_t number) { return facets_[number]; }
  /// Returns an interface's facet as label `second` has it, with its rows of doubled vertices.
  [[nodiscard]] Facet of_second(const Facet& facet);
  /// Returns the middles of the facet's edges 0 1, 1 2, 2 0.  REQUIRES: has_middles(element()).
  [[nodiscard]] std::array<std::uint64_t, 3> facet_middles(const Facet& facet);
  [[nodiscard]] NodeRows facet_nodes(const Facet& facet);

  /// Returns the groups that have wedges, in the order of their facets: those of the interfaces
  /// that header().record.cohesive names.
  [[nodiscard]] const std::vector<WedgeGroup>& wedge_groups() const { return wedge_groups_; }
  /// Wedges are numbered by group, and in a group by facet.  A facet without a doubled vertex has
  /// none.
  [[nodiscard]] std::uint64_t wedge_count() const { return wedges_.size(); }
  [[nodiscard]] Wedge wedge(std::uint64_t number) { return wedges_[number]; }
  /// Returns 6 nodes, or 12 where tets have middles.
  [[nodiscard]] NodeRows wedge_nodes(const Wedge& wedge);

 private:
  friend class GroupedSink;

  explicit GroupedMesh(const std::filesystem::path& folder);

  std::filesystem::path folder_;
  MeshHeader header_;
  LabelTable table_;
  MeshBox box_;
  Element element_ = Element::kTet4;
  double largest_coordinate_ = 0;
  double shortest_square_ = std::numeric_limits<double>::infinity();
  double least_volume6_ = std::numeric_limits<double>::infinity();
  ScratchMesh* source_ = nullptr;  ///< has the vertices
  PagedArray<TetRows> tets_;
  PagedArray<double> values_;  ///< by tet, one for each name
  std::vector<RowRange> label_tets_;
  PagedFile<Facet> facets_;
  FacetGroups facet_groups_;
  PagedFile<Wedge> wedges_;
  std::vector<WedgeGroup> wedge_groups_;
  PagedFile<std::array<std::uint64_t, 2>> edges_;    ///< corners of each edge, with middles only
  PagedFile<std::array<std::uint64_t, 6>> middles_;  ///< by tet, with middles only
  PagedArray<Position>* curved_nodes_ = nullptr;     ///< null without curves
};

/// Calls visit(run) on the interfaces and on each side of the box, in the order of their facets: a
/// run is a group, or all groups of a side in one, with the first of their labels.
template <class Visit>
void for_each_facet_run(const GroupedMesh& mesh, Visit visit) {
  std::optional<FacetGroup> run;
  for (const FacetGroup& group : mesh.facet_groups()) {
    if (run && run->side == group.side && group.side != Side::kInterface) {
      run->facets.end = group.facets.end;
      continue;
    }
    if (run) visit(*run);
    run = group;
  }
  if (run) visit(*run);
}

/// Writes a grouped mesh into the file that was opened for it, and commits that.  Called once.
/// ERRORS: see MeshSink.
using WriteGrouped = std::function<void(GroupedMesh& mesh)>;

/// Writes all nodes into the sink, in row order.
void write_nodes(GroupedMesh& mesh, MeshSink& sink);

}  // namespace mw::io
