// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pairs of touching parts, Euler sums, and Betti numbers from both (kernels/topology/README.md,
// "Betti numbers of closed and open regions").
#include "kernels/audit/topology/part_graph.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "kernels/core/disjoint_sets.h"
#include "kernels/core/sort_distinct.h"

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

void PairSet::add(std::uint32_t a, std::uint32_t b) {
  if (a == b) return;
  const PartPair pair{std::min(a, b), std::max(a, b)};
  PartPair& seen = recent_[(pair.a * 2654435761U + pair.b * 40503U) % kRecent];
  if (seen == pair) return;
  seen = pair;
  pairs_.add(pair);
}

std::vector<PartPair> PairSet::take() {
  recent_.assign(kRecent, {});
  return pairs_.take();
}

void PartGraph::add_vertex(std::span<const std::uint32_t> parts,
                           std::span<const Label> part_class) {
  // Classes are contiguous.  A chain falls apart only where a whole class is taken out of its
  // middle, so the last part before each class is also joined to the first one after it.
  std::size_t class_begin = 0;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    by_vertex_.add(parts[i - 1], parts[i]);
    if (part_class[parts[i - 1]] == part_class[parts[i]]) continue;
    if (class_begin > 0) by_vertex_.add(parts[class_begin - 1], parts[i]);
    class_begin = i;
  }
}

void EulerSums::add(std::int64_t sign, std::span<const Label> classes) {
  total += sign;
  for (const Label c : classes) closed[c] += sign;
  if (classes.size() == 1) only[classes[0]] += sign;
}

void EulerSums::add(const ClassCells& cells) {
  closed[cells.label] += cells.closed;
  only[cells.label] += cells.only;
}

std::vector<ClassCells> EulerSums::cells() const {
  std::vector<ClassCells> out;
  for (Label c = 0; c < closed.size(); ++c) {
    if (closed[c] != 0 || only[c] != 0) out.push_back({c, closed[c], only[c]});
  }
  return out;
}

std::vector<std::int64_t> components_within(std::span<const Label> part_class,
                                            std::span<const PartPair> pairs,
                                            std::size_t class_count) {
  DisjointSets sets(part_class.size());
  for (const PartPair& pair : pairs) {
    if (part_class[pair.a] == part_class[pair.b]) sets.unite(pair.a, pair.b);
  }
  std::vector<std::int64_t> components(class_count, 0);
  for (std::uint32_t part = 0; part < part_class.size(); ++part) {
    if (sets.find(part) == part) ++components[part_class[part]];
  }
  return components;
}

std::vector<RegionBetti> betti_of_parts(std::span<const Label> part_class,
                                        std::span<const PartPair> face_pairs,
                                        std::span<const PartPair> vertex_pairs,
                                        const EulerSums& euler) {
  const std::size_t class_count = euler.closed.size();
  const auto rest_by_face = components_without(part_class, face_pairs, class_count);
  const auto own_by_vertex = components_within(part_class, vertex_pairs, class_count);
  const auto rest_by_vertex = components_without(part_class, vertex_pairs, class_count);
  const auto own_by_face = components_within(part_class, {}, class_count);

  std::vector<RegionBetti> betti(class_count);
  for (std::size_t c = 0; c < class_count; ++c) {
    if (own_by_face[c] == 0) continue;
    Betti& closed = betti[c].closed;
    closed.b0 = own_by_vertex[c];
    closed.b2 = rest_by_face[c] - 1;
    closed.b1 = closed.b0 + closed.b2 - euler.closed[c];
    const Betti rest{rest_by_vertex[c], 0, own_by_face[c] - 1};
    const std::int64_t rest_chi = euler.total - euler.only[c];
    betti[c].open = {own_by_face[c], rest.b0 + rest.b2 - rest_chi, rest.b0 - 1};
  }
  return betti;
}

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

Cavities cavities_of_interfaces(std::span<const Label> part_class,
                                const std::vector<PartPair>& face_pairs) {
  std::vector<JunctionLabels> groups;
  const auto group_of = [&](const PartPair& p) {
    const auto [a, b] = std::minmax(part_class[p.a], part_class[p.b]);
    return JunctionLabels{a, b, kNoLabel, kNoLabel};
  };
  for (const PartPair& p : face_pairs) groups.push_back(group_of(p));
  sort_distinct(groups);
  std::vector<GroupedPair> pairs;
  for (const PartPair& p : face_pairs) {
    const auto found = std::lower_bound(groups.begin(), groups.end(), group_of(p));
    const auto group = static_cast<std::uint32_t>(found - groups.begin());
    pairs.push_back({p, group, group});
  }
  const auto components = components_leaving_out(part_class.size(), pairs, groups.size());
  Cavities out;
  for (std::size_t i = 0; i < groups.size(); ++i) out[groups[i]] = components[i] - 1;
  return out;
}

}  // namespace mw::audit
