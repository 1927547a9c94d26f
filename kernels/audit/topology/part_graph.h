// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The face-connected parts of all labels, numbered so that those of a class follow each other,
// which of them touch, and Betti numbers from that.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "kernels/audit/topology/betti.h"
#include "kernels/audit/topology/junctions.h"
#include "kernels/core/disjoint_sets.h"
#include "kernels/core/label.h"
#include "kernels/core/sort_distinct.h"

namespace mw::audit {

/// The parts (sets) of all members, numbered by class and then by first member.
struct Parts {
  std::vector<std::uint32_t> of_member;
  std::vector<Label> part_class;  ///< ascending
};

/// Numbers the sets.  class_of(root) < class_count is asked once or twice for every root.
template <class ClassOf>
Parts number_parts(DisjointSets&& sets, std::size_t class_count, ClassOf&& class_of) {
  Parts parts{sets.take_parents(), {}};
  std::vector<std::uint32_t> next(class_count + 1, 0);
  const std::size_t count = parts.of_member.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (parts.of_member[i] == i) ++next[class_of(i) + 1];
  }
  for (std::size_t c = 0; c < class_count; ++c) {
    parts.part_class.insert(parts.part_class.end(), next[c + 1], static_cast<Label>(c));
    next[c + 1] += next[c];
  }
  // Parents are smaller, hence already replaced by their number when a member is reached.
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t parent = parts.of_member[i];
    parts.of_member[i] = parent == i ? next[class_of(i)]++ : parts.of_member[parent];
  }
  return parts;
}

/// A list that is given the same values again and again.  Memory: at most twice the distinct ones,
/// or `first_limit` if that is more.
template <class T>
class DistinctList {
 public:
  explicit DistinctList(std::size_t first_limit) : first_limit_(first_limit) {}

  void add(const T& value) {
    if (values_.size() == limit_) compact();
    values_.push_back(value);
  }
  /// Returns the distinct values, ascending; the list is empty afterwards.
  [[nodiscard]] std::vector<T> take() {
    compact();
    return std::exchange(values_, {});
  }

 private:
  void compact() {
    sort_distinct(values_);
    limit_ = std::max(first_limit_, 2 * values_.size());
  }

  std::vector<T> values_;
  std::size_t first_limit_;
  std::size_t limit_ = first_limit_;
};

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
