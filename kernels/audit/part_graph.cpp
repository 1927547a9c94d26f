// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pairs of touching parts, Euler sums, and Betti numbers from both (kernels/topology/README.md,
// "Betti numbers of closed and open regions").
#include "kernels/audit/part_graph.h"

#include <algorithm>
#include <utility>

#include "kernels/audit/disjoint_sets.h"

namespace mw::audit {

void PairSet::add(std::uint32_t a, std::uint32_t b) {
  if (a == b) return;
  const PartPair pair{std::min(a, b), std::max(a, b)};
  PartPair& seen = recent_[(pair.a * 2654435761U + pair.b * 40503U) % kRecent];
  if (seen == pair) return;
  seen = pair;
  if (pairs_.size() == limit_) compact();
  pairs_.push_back(pair);
}

void PairSet::compact() {
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  limit_ = std::max(kFirstLimit, 2 * pairs_.size());
}

std::vector<PartPair> PairSet::take() {
  compact();
  recent_.assign(kRecent, {});
  return std::exchange(pairs_, {});
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

}  // namespace mw::audit
