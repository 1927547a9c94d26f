// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The face-connected parts of all labels, which of them touch, and Betti numbers from that.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "kernels/audit/topology/betti.h"
#include "kernels/audit/topology/distinct_list.h"
#include "kernels/audit/topology/junctions.h"
#include "kernels/core/label.h"

namespace mw::audit {

/// Two different parts that touch, smaller first.
struct PartPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;

  friend auto operator<=>(const PartPair&, const PartPair&) = default;
};

/// A set of pairs that is fed the same pairs again and again.  Memory: at most twice the distinct
/// pairs, or kFirstLimit if that is more.
class PairSet {
 public:
  void add(std::uint32_t a, std::uint32_t b);
  /// Sorted and distinct; the set is empty afterwards.
  [[nodiscard]] std::vector<PartPair> take();

 private:
  static constexpr std::size_t kFirstLimit = std::size_t{1} << 20;
  static constexpr std::size_t kRecent = std::size_t{1} << 14;

  DistinctList<PartPair> pairs_{kFirstLimit};
  std::vector<PartPair> recent_ = std::vector<PartPair>(kRecent);  ///< filter only, never read out
};

/// Which parts touch.  Two closed parts meet iff they share a vertex of the complex.
class PartGraph {
 public:
  /// Notes that two parts meet in a face.
  void add_face(std::uint32_t a, std::uint32_t b) { by_face_.add(a, b); }
  /// Notes that all these parts meet in a vertex, by few pairs that still connect the other parts
  /// when any one class is taken away.  REQUIRES: parts ascending, distinct; part_class ascending.
  void add_vertex(std::span<const std::uint32_t> parts, std::span<const Label> part_class);

  [[nodiscard]] std::vector<PartPair> take_face_pairs() { return by_face_.take(); }
  [[nodiscard]] std::vector<PartPair> take_vertex_pairs() { return by_vertex_.take(); }

 private:
  PairSet by_face_;
  PairSet by_vertex_;
};

/// Cells in the closure of a class, as EulerSums count them.
struct ClassCells {
  Label label = 0;
  std::int64_t closed = 0;
  std::int64_t only = 0;
};

/// What one tile tells of the parts of all labels, its parts numbered from 0.
struct PartsPiece {
  std::vector<Label> part_class;  ///< ascending
  std::vector<PartPair> face_pairs;
  std::vector<PartPair> vertex_pairs;
  std::vector<ClassCells> cells;  ///< ascending
  std::int64_t total = 0;         ///< see EulerSums
};

/// Euler characteristics of all labels, as sums over the cells of the 3-sphere.
struct EulerSums {
  explicit EulerSums(std::size_t class_count) : closed(class_count), only(class_count) {}

  /// Adds a cell with sign (-1)^dimension and the distinct classes of the 3-cells around it.
  void add(std::int64_t sign, std::span<const Label> classes);
  void add(const ClassCells& cells);
  /// Classes with a cell, ascending.
  [[nodiscard]] std::vector<ClassCells> cells() const;

  std::vector<std::int64_t> closed;  ///< cells in the closure of the class
  std::vector<std::int64_t> only;    ///< cells in the closure of nothing else
  std::int64_t total = 0;            ///< all cells; 0 for a 3-sphere
};

/// A pair that is in one group or in two.
struct GroupedPair {
  PartPair parts;
  std::uint32_t group = 0;
  std::uint32_t other_group = 0;
};

/// Number of components of the graph without the pairs of group g, for every g: offline divide and
/// conquer over the groups with a union-find that can undo.
/// Cost: O(E log G log P) for E pairs, G groups and P parts.
[[nodiscard]] std::vector<std::int64_t> components_leaving_out(
    std::size_t parts, const std::vector<GroupedPair>& pairs, std::size_t group_count);

/// Number of components of the graph without the parts of class c, for every c.
[[nodiscard]] std::vector<std::int64_t> components_without(std::span<const Label> part_class,
                                                           std::span<const PartPair> pairs,
                                                           std::size_t class_count);

/// Number of components of the parts of class c alone, for every c.
[[nodiscard]] std::vector<std::int64_t> components_within(std::span<const Label> part_class,
                                                          std::span<const PartPair> pairs,
                                                          std::size_t class_count);

/// Betti numbers of every class.  With C = closure of all other classes and Alexander duality in
/// the 3-sphere:
///   closed: b0 = its parts joined through vertices, b2 = face-components of the others - 1;
///   open:   b0 = its parts, b2 = b0(C) - 1, b1 = b1(C) where b2(C) = b0(open) - 1;
/// and the missing b1 follows from the Euler characteristic (chi(C) = total - only).
[[nodiscard]] std::vector<RegionBetti> betti_of_parts(std::span<const Label> part_class,
                                                      std::span<const PartPair> face_pairs,
                                                      std::span<const PartPair> vertex_pairs,
                                                      const EulerSums& euler);

/// Cavities (b2) by pair of labels, for all pairs with an interface.
using Cavities = std::map<JunctionLabels, std::int64_t>;

/// By Alexander duality in the 3-sphere they are the components of the part graph without the pairs
/// of parts that have these two labels, less one.  Cost: as components_leaving_out().
[[nodiscard]] Cavities cavities_of_interfaces(std::span<const Label> part_class,
                                              const std::vector<PartPair>& face_pairs);

}  // namespace mw::audit
