// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells by sorting, components by union-find.
#include "kernels/audit/topology/junction_counter.h"

#include <algorithm>
#include <limits>

#include "kernels/core/error.h"

namespace mw::audit {
namespace {

constexpr JunctionLabels kNoPosition{kNoLabel, kNoLabel, kNoLabel, kNoLabel};

/// Calls visit(JunctionLabels) for every set of 2 .. kMaxLabelsOfJunction of the labels, given that
/// the first `size` of `junction` are chosen and the others come from labels[next ..].
template <class Visit>
void each_place(std::span<const Label> labels, std::size_t next, JunctionLabels junction,
                std::size_t size, Visit& visit) {
  if (size >= 2) visit(junction);
  if (size == kMaxLabelsOfJunction) return;
  for (; next < labels.size(); ++next) {
    junction[size] = labels[next];
    each_place(labels, next + 1, junction, size + 1, visit);
  }
}

}  // namespace

std::uint64_t JunctionCounter::id(const JunctionLabels& junction) {
  if (junction == last_junction_ && !ids_.empty()) return last_id_;
  last_junction_ = junction;
  last_id_ = ids_.try_emplace(junction, ids_.size()).first->second;
  euler_.resize(ids_.size());
  return last_id_;
}

void JunctionCounter::add_vertex(const JunctionLabels& junction, std::uint64_t v) {
  nodes_.add(node(junction, v));
}

void JunctionCounter::add_edge(const JunctionLabels& junction, std::uint64_t v, std::uint64_t w) {
  links_.add({node(junction, v), node(junction, w)});
  if (!vertices_.owned[w]) nodes_.add(node(junction, w));
}

void JunctionCounter::add_face(const JunctionLabels& pair) {
  ++euler_[id(pair)];
}

DisjointSets JunctionCounter::link(const std::vector<std::uint64_t>& nodes) {
  if (nodes.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kResource, "audit: more than 2^32 vertices on interfaces; audit parts");
  }
  const auto row = [&](std::uint64_t node) {
    const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
    return static_cast<std::uint32_t>(found - nodes.begin());
  };
  DisjointSets sets(nodes.size());
  for (const Link& link : links_.take()) {
    sets.unite(row(link.a), row(link.b));
    --euler_[link.a / vertices_.count()];
  }
  for (const std::uint64_t node : nodes) {
    if (vertices_.owned[node % vertices_.count()]) ++euler_[node / vertices_.count()];
  }
  return sets;
}

void JunctionCounter::take(JunctionKind kind, JunctionsPiece& out) {
  const std::vector<std::uint64_t> nodes = nodes_.take();
  DisjointSets sets = link(nodes);
  std::vector<std::uint32_t> tally_of(ids_.size());
  for (const auto& [junction, id] : ids_) {
    tally_of[id] = static_cast<std::uint32_t>(out.tallies.size());
    out.tallies.push_back({junction, kind, 0, euler_[id]});
  }
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(nodes.size(), kNone);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t tally = tally_of[nodes[i] / vertices_.count()], root = sets.find(i);
    const std::uint64_t v = nodes[i] % vertices_.count();
    if (root == i) ++out.tallies[tally].components;
    if (!vertices_.shared[v]) continue;
    if (number[root] == kNone) number[root] = out.open_sets++;
    out.shared.push_back({tally, vertices_.ids[v], number[root]});
  }
}

void JunctionSweep::add_vertex(std::span<const Label> labels, std::uint64_t v) {
  const auto add = [&](const JunctionLabels& junction) { meetings_.add_vertex(junction, v); };
  each_place(labels, 0, kNoPosition, 0, add);
}

void JunctionSweep::add_edge(std::span<const Label> labels, std::uint64_t v, std::uint64_t w) {
  const auto add = [&](const JunctionLabels& junction) { meetings_.add_edge(junction, v, w); };
  each_place(labels, 0, kNoPosition, 0, add);
}

void JunctionSweep::add_face(std::span<const Label> labels,
                             std::span<const std::uint64_t> vertices) {
  if (labels.size() < 2) return;
  const bool is_owned = vertices_.owned[*std::min_element(vertices.begin(), vertices.end())];
  const auto add = [&](const JunctionLabels& junction) {
    if (is_owned) {
      meetings_.add_face(junction);
      interfaces_.add_face(junction);
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const auto [v, w] = std::minmax(vertices[i], vertices[(i + 1) % vertices.size()]);
      if (vertices_.owned[vertices[i]]) interfaces_.add_vertex(junction, vertices[i]);
      if (vertices_.owned[v]) interfaces_.add_edge(junction, v, w);
    }
  };
  each_place(labels, 0, kNoPosition, 0, add);
}

JunctionsPiece JunctionSweep::take() {
  JunctionsPiece out;
  interfaces_.take(JunctionKind::kInterface, out);
  meetings_.take(JunctionKind::kMeeting, out);
  return out;
}

}  // namespace mw::audit
