// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Brute-force oracle: Betti numbers of regions by GF(2) ranks of boundary matrices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "kernels/audit/subject.h"
#include "kernels/audit/topology/betti.h"

namespace mw::audit::test {

/// Betti numbers of places, by the labels that make them.
using BettiOfJunctions = std::map<std::set<Label>, Betti>;

/// What KeptTopology::kInterfaces keeps besides the labels.
struct JunctionsBetti {
  BettiOfJunctions meetings;    ///< of all sets of 2 to 4 labels, where they meet
  BettiOfJunctions interfaces;  ///< of all pairs that share a face

  friend bool operator==(const JunctionsBetti&, const JunctionsBetti&) = default;
};

/// A regular cell complex whose 3-cells are labelled and fill the 3-sphere.
class CellComplex {
 public:
  /// Boundary: ids of cells of one dimension less.
  std::size_t add(std::size_t dimension, std::vector<std::size_t> boundary);
  void set_label(std::size_t cell, Label label);
  /// Tells every cell the labels of the 3-cells above it.  REQUIRES: faces added before cells.
  void spread_labels();

  /// Closed region: the cells with the label above them.
  [[nodiscard]] Betti closed(Label label) const;
  /// Open region: it retracts to the dual blocks of the cells with nothing but the label above.
  [[nodiscard]] Betti open(Label label) const;
  /// For every set of 2 .. most labels, where all of them meet: the cells with all of them above.
  /// Only sets that meet somewhere.
  [[nodiscard]] BettiOfJunctions meetings(std::size_t max) const;
  /// For every pair of labels, the closure of the faces between them.  Only pairs with a face.
  [[nodiscard]] BettiOfJunctions interfaces() const;

 private:
  struct Cell {
    std::size_t dimension;
    std::vector<std::size_t> boundary;
    std::set<Label> above;
  };

  using Cells = std::vector<std::size_t>;  ///< ascending

  /// Number of cells less ranks of both boundary maps, for dimensions 0 .. 3.
  [[nodiscard]] std::vector<std::int64_t> homology(const Cells& kept) const;
  [[nodiscard]] std::int64_t boundary_rank(const Cells& kept, std::size_t dimension) const;
  [[nodiscard]] BettiOfJunctions betti_of(const std::map<std::set<Label>, Cells>& junctions) const;

  std::vector<Cell> cells_;
};

/// Vertices, edges, faces and voxels, and one cell outside the box (label label_count).
[[nodiscard]] CellComplex complex_of(const VoxelLabels& volume, std::size_t label_count);

/// Simplices of the mesh, and one cell outside (label label_count).
[[nodiscard]] CellComplex complex_of(const AuditMesh& mesh, std::size_t label_count);

/// Closed and open of labels 0 .. label_count.
[[nodiscard]] std::vector<RegionBetti> betti_of(const CellComplex& complex,
                                                std::size_t label_count);

[[nodiscard]] JunctionsBetti junctions_of(const CellComplex& complex);

}  // namespace mw::audit::test
