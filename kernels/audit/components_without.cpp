// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Components of the part graph without each class or group in turn, for all of them at once.
#include <algorithm>
#include <numeric>
#include <utility>

#include "kernels/audit/part_graph.h"

namespace mw::audit {
namespace {

/// Union by size without path compression, so that the last unions can be taken back.
class UndoableSets {
 public:
  explicit UndoableSets(std::size_t count) : parent_(count), size_(count, 1) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
    joined_.push_back(b);
  }

  [[nodiscard]] std::size_t unions() const { return joined_.size(); }

  void undo_to(std::size_t unions) {
    for (; joined_.size() > unions; joined_.pop_back()) {
      const std::uint32_t child = joined_.back();
      size_[parent_[child]] -= size_[child];
      parent_[child] = child;
    }
  }

 private:
  [[nodiscard]] std::uint32_t root(std::uint32_t member) const {
    while (parent_[member] != member) member = parent_[member];
    return member;
  }

  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> size_;
  std::vector<std::uint32_t> joined_;
};

class GroupSolver {
 public:
  GroupSolver(std::size_t parts, std::size_t groups) : parts_(parts), sets_(parts) {
    count_.resize(groups);
  }

  /// Fills count_ for groups lo .. hi-1.  INVARIANT: `touching` are the pairs of these groups; all
  /// other pairs are united already.
  void solve(std::size_t lo, std::size_t hi, const std::vector<GroupedPair>& touching) {
    if (hi - lo == 1) {
      count_[lo] = static_cast<std::int64_t>(parts_ - sets_.unions());
      return;
    }
    const std::size_t mid = lo + (hi - lo) / 2;
    descend(lo, mid, touching);
    descend(mid, hi, touching);
  }

  [[nodiscard]] std::vector<std::int64_t> take() { return std::move(count_); }

 private:
  void descend(std::size_t lo, std::size_t hi, const std::vector<GroupedPair>& pairs) {
    const std::size_t mark = sets_.unions();
    std::vector<GroupedPair> touching;
    const auto inside = [&](std::uint32_t group) { return group >= lo && group < hi; };
    for (const GroupedPair& pair : pairs) {
      if (inside(pair.group) || inside(pair.other_group)) {
        touching.push_back(pair);
      } else {
        sets_.unite(pair.parts.a, pair.parts.b);
      }
    }
    solve(lo, hi, touching);
    sets_.undo_to(mark);
  }

  std::size_t parts_;
  UndoableSets sets_;
  std::vector<std::int64_t> count_;
};

}  // namespace

std::vector<std::int64_t> components_leaving_out(std::size_t parts,
                                                 const std::vector<GroupedPair>& pairs,
                                                 std::size_t group_count) {
  GroupSolver solver(parts, group_count);
  if (group_count > 0) solver.solve(0, group_count, pairs);
  return solver.take();
}

std::vector<std::int64_t> components_without(std::span<const Label> part_class,
                                             std::span<const PartPair> pairs,
                                             std::size_t class_count) {
  std::vector<GroupedPair> grouped;
  grouped.reserve(pairs.size());
  for (const PartPair& p : pairs) grouped.push_back({p, part_class[p.a], part_class[p.b]});
  auto count = components_leaving_out(part_class.size(), grouped, class_count);
  for (const Label c : part_class) --count[c];  // alone without their pairs
  return count;
}

}  // namespace mw::audit
