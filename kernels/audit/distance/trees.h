// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Points, boxes and triangles in voxel units, how far a point is from them, and the nearest of the
// things that bound a label: one tree of boxes for every label.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "kernels/core/label.h"

namespace mw::audit {

/// A point in voxels: (p - origin) / spacing along each axis.
using VoxelPoint = std::array<double, 3>;

/// A triangle by its corners, in any order.
using VoxelTriangle = std::array<VoxelPoint, 3>;

/// All points between two corners; flat for a voxel face.
struct Extent {
  VoxelPoint lo{};
  VoxelPoint hi{};
};

[[nodiscard]] inline double squared_distance(const VoxelPoint& p, const Extent& box) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double away = std::max(std::max(box.lo[k] - p[k], p[k] - box.hi[k]), 0.0);
    sum += away * away;
  }
  return sum;
}

/// Squared distance to the nearest point of a triangle, which may be degenerate.  Up to rounding it
/// is always the distance to some point of the triangle, so none ever seems nearer than it is.
[[nodiscard]] double squared_distance(const VoxelPoint& p, const VoxelTriangle& t);

[[nodiscard]] inline Extent extent_of(const VoxelTriangle& t) {
  Extent box{t[0], t[0]};
  for (std::size_t k = 0; k < 3; ++k) {
    box.lo[k] = std::min({t[0][k], t[1][k], t[2][k]});
    box.hi[k] = std::max({t[0][k], t[1][k], t[2][k]});
  }
  return box;
}

/// Position of a cell along a space-filling curve (Morton 1966).  REQUIRES: coordinates < 2^20.
[[nodiscard]] std::uint64_t curve_position(const std::array<std::uint32_t, 3>& cell);

/// The two labels that a face or triangle bounds.
using LabelPair = std::array<Label, 2>;

/// For every label, the items that bound it in a packed tree: each node covers up to kFan
/// consecutive nodes or items, so items that follow each other should lie near each other.
/// Memory: 24 bytes an item for its two labels.  Thread-safe when const.
class LabelTrees {
 public:
  struct Nearest {
    double squared = std::numeric_limits<double>::infinity();
    std::uint32_t item = 0;
  };

  /// labels_of(item) -> LabelPair below label_count; extent_of(item) -> Extent.
  template <class LabelsOf, class ExtentOf>
  LabelTrees(std::size_t label_count, std::size_t items, LabelsOf&& labels_of,
             ExtentOf&& extent_of);

  [[nodiscard]] bool empty(Label label) const { return begin_[label] == begin_[label + 1]; }

  /// Returns the nearest item of the label if it is nearer than `best`, else `best`.  The search
  /// ends early with an item whose squared distance is at most `enough`.
  /// squared_distance_to(item) -> double.  The distance found does not depend on `best` as long as
  /// that is an item of the label.
  /// Cost: O(log items) for points near them, whatever the distance to the others.
  template <class SquaredDistance>
  [[nodiscard]] Nearest nearest(Label label, const VoxelPoint& p, Nearest best,
                                SquaredDistance&& squared_distance_to, double enough = -1) const;

 private:
  static constexpr std::uint64_t kFan = 4;
  static constexpr std::size_t kMaxLevels = 33;

  /// A box in single precision, widened by more than that rounds.
  struct Box {
    std::array<float, 3> lo;
    std::array<float, 3> hi;
  };
  /// Nodes of one level of a tree; level 0 covers items.
  struct Level {
    std::uint64_t begin = 0;
    std::uint64_t count = 0;
  };
  struct Waiting {
    double squared;
    std::uint64_t node;
    std::size_t level;
  };
  /// Nodes to look at, the nearest on top.
  struct Stack {
    std::array<Waiting, kFan * kMaxLevels> nodes;
    std::size_t size = 0;
  };

  static Box widened(const Extent& extent);
  template <class Bounds>
  static Bounds joined(const Bounds& a, const Bounds& b) {
    Bounds out{};
    for (std::size_t k = 0; k < 3; ++k) {
      out.lo[k] = std::min(a.lo[k], b.lo[k]);
      out.hi[k] = std::max(a.hi[k], b.hi[k]);
    }
    return out;
  }
  static double squared_distance_to_box(const VoxelPoint& p, const Box& box);

  template <class ExtentOf>
  void add_leaves(Label label, ExtentOf&& extent_of);
  /// Adds the levels above the leaves of the last label.
  void add_levels();
  void push_children(const Waiting& parent, std::span<const Level> levels, const VoxelPoint& p,
                     double limit, Stack& stack) const;

  std::vector<std::uint64_t> begin_;  ///< where each label's items begin
  std::vector<std::uint32_t> items_;
  std::vector<Box> boxes_;
  std::vector<Level> levels_;
  std::vector<std::uint64_t> level_begin_;  ///< where each label's levels begin
};

inline double LabelTrees::squared_distance_to_box(const VoxelPoint& p, const Box& box) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double below = static_cast<double>(box.lo[k]) - p[k];
    const double above = p[k] - static_cast<double>(box.hi[k]);
    const double away = std::max(std::max(below, above), 0.0);
    sum += away * away;
  }
  return sum;
}

inline void LabelTrees::push_children(const Waiting& parent, std::span<const Level> levels,
                                      const VoxelPoint& p, double limit, Stack& stack) const {
  const Level& level = levels[parent.level - 1];
  const std::uint64_t first = parent.node * kFan;
  const std::uint64_t end = std::min(first + kFan, level.count);
  const std::size_t bottom = stack.size;
  for (std::uint64_t i = first; i < end; ++i) {
    const double squared = squared_distance_to_box(p, boxes_[level.begin + i]);
    if (squared >= limit) continue;
    std::size_t at = stack.size++;
    for (; at > bottom && stack.nodes[at - 1].squared < squared; --at) {
      stack.nodes[at] = stack.nodes[at - 1];
    }
    stack.nodes[at] = {squared, i, parent.level - 1};
  }
}

template <class LabelsOf, class ExtentOf>
LabelTrees::LabelTrees(std::size_t label_count, std::size_t items, LabelsOf&& labels_of,
                       ExtentOf&& extent_of)
    : begin_(label_count + 1, 0) {
  for (std::size_t i = 0; i < items; ++i) {
    for (const Label label : labels_of(i)) ++begin_[label + 1];
  }
  for (std::size_t l = 0; l < label_count; ++l) begin_[l + 1] += begin_[l];
  items_.resize(begin_.back());
  std::vector<std::uint64_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < items; ++i) {
    for (const Label label : labels_of(i)) items_[next[label]++] = static_cast<std::uint32_t>(i);
  }
  boxes_.reserve(items_.size() / (kFan - 1) + 2 * label_count);
  level_begin_.push_back(0);
  for (std::size_t l = 0; l < label_count; ++l) {
    add_leaves(static_cast<Label>(l), extent_of);
    add_levels();
    level_begin_.push_back(levels_.size());
  }
}

template <class ExtentOf>
void LabelTrees::add_leaves(Label label, ExtentOf&& extent_of) {
  if (empty(label)) return;
  const Level leaves{boxes_.size(), (begin_[label + 1] - begin_[label] + kFan - 1) / kFan};
  for (std::uint64_t first = begin_[label]; first < begin_[label + 1]; first += kFan) {
    const std::uint64_t end = std::min(first + kFan, begin_[label + 1]);
    Extent all = extent_of(items_[first]);
    for (std::uint64_t i = first + 1; i < end; ++i) all = joined(all, extent_of(items_[i]));
    boxes_.push_back(widened(all));
  }
  levels_.push_back(leaves);
}

template <class SquaredDistance>
LabelTrees::Nearest LabelTrees::nearest(Label label, const VoxelPoint& p, Nearest best,
                                        SquaredDistance&& squared_distance_to,
                                        double enough) const {
  const std::span<const Level> levels = std::span(levels_).subspan(
      level_begin_[label], level_begin_[label + 1] - level_begin_[label]);
  if (levels.empty()) return best;
  Stack stack;
  stack.nodes[stack.size++] = {0, 0, levels.size() - 1};
  while (stack.size > 0 && best.squared > enough) {
    const Waiting node = stack.nodes[--stack.size];
    if (node.squared >= best.squared) continue;
    if (node.level > 0) {
      push_children(node, levels, p, best.squared, stack);
      continue;
    }
    const std::uint64_t first = begin_[label] + node.node * kFan;
    const std::uint64_t end = std::min(first + kFan, begin_[label + 1]);
    for (std::uint64_t i = first; i < end; ++i) {
      const double squared = squared_distance_to(items_[i]);
      if (squared < best.squared) best = {squared, items_[i]};
    }
  }
  return best;
}

}  // namespace mw::audit
