// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells by sorting, components by union-find, cavities by duality.
#include "kernels/audit/place_counter.h"

#include <algorithm>
#include <limits>

#include "kernels/audit/disjoint_sets.h"
#include "kernels/core/error.h"

namespace mw::audit {
namespace {

constexpr PlaceLabels kNoPlace{kNoLabel, kNoLabel, kNoLabel, kNoLabel};

PlaceLabels pair_of(Label a, Label b) {
  return {std::min(a, b), std::max(a, b), kNoLabel, kNoLabel};
}

/// Calls visit(PlaceLabels) for every set of 2 .. kMostLabelsOfPlace of the labels, given that the
/// first `size` of `place` are chosen and the others come from labels[next ..].
template <class Visit>
void each_place(std::span<const Label> labels, std::size_t next, PlaceLabels place,
                std::size_t size, Visit& visit) {
  if (size >= 2) visit(place);
  if (size == kMostLabelsOfPlace) return;
  for (; next < labels.size(); ++next) {
    place[size] = labels[next];
    each_place(labels, next + 1, place, size + 1, visit);
  }
}

}  // namespace

Cavities cavities_of_interfaces(std::span<const Label> part_class,
                                const std::vector<PartPair>& face_pairs) {
  std::vector<PlaceLabels> groups;
  const auto group_of = [&](const PartPair& p) {
    return pair_of(part_class[p.a], part_class[p.b]);
  };
  for (const PartPair& p : face_pairs) groups.push_back(group_of(p));
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
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

std::uint64_t PlaceCounter::id(const PlaceLabels& place) {
  if (place == last_place_ && !ids_.empty()) return last_id_;
  last_place_ = place;
  last_id_ = ids_.try_emplace(place, ids_.size()).first->second;
  euler_.resize(ids_.size());
  return last_id_;
}

void PlaceCounter::add_vertex(const PlaceLabels& place, std::uint64_t v) {
  nodes_.add(node(place, v));
}

void PlaceCounter::add_edge(const PlaceLabels& place, std::uint64_t v, std::uint64_t w) {
  links_.add({node(place, std::min(v, w)), node(place, std::max(v, w))});
}

void PlaceCounter::add_face(const PlaceLabels& pair) {
  ++euler_[id(pair)];
}

void PlaceCounter::count_cells() {
  const std::vector<std::uint64_t>& nodes = nodes_.sorted();
  if (nodes.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kResource, "audit: more than 2^32 vertices on interfaces; audit parts");
  }
  const auto row = [&](std::uint64_t node) {
    const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
    return static_cast<std::uint32_t>(found - nodes.begin());
  };
  DisjointSets sets(nodes.size());
  for (const Link& link : links_.sorted()) {
    sets.unite(row(link.a), row(link.b));
    --euler_[link.a / vertex_count_];
  }
  components_.assign(ids_.size(), 0);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const std::uint64_t place = nodes[i] / vertex_count_;
    ++euler_[place];
    if (sets.find(i) == i) ++components_[place];
  }
}

std::vector<PlaceBetti> PlaceCounter::take(const Cavities& cavities) {
  count_cells();
  std::vector<PlaceBetti> out;
  for (const auto& [place, id] : ids_) {
    const auto found = cavities.find(place);
    const std::int64_t b0 = components_[id], b2 = found == cavities.end() ? 0 : found->second;
    out.push_back({place, {b0, b0 + b2 - euler_[id], b2}});
  }
  return out;
}

void PlaceSweep::add_vertex(std::span<const Label> labels, std::uint64_t v) {
  const auto add = [&](const PlaceLabels& place) { meetings_.add_vertex(place, v); };
  each_place(labels, 0, kNoPlace, 0, add);
}

void PlaceSweep::add_edge(std::span<const Label> labels, std::uint64_t v, std::uint64_t w) {
  const auto add = [&](const PlaceLabels& place) { meetings_.add_edge(place, v, w); };
  each_place(labels, 0, kNoPlace, 0, add);
}

void PlaceSweep::add_face(std::span<const Label> labels, std::span<const std::uint64_t> vertices) {
  const auto add = [&](const PlaceLabels& place) {
    meetings_.add_face(place);
    interfaces_.add_face(place);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      interfaces_.add_vertex(place, vertices[i]);
      interfaces_.add_edge(place, vertices[i], vertices[(i + 1) % vertices.size()]);
    }
  };
  each_place(labels, 0, kNoPlace, 0, add);
}

Places PlaceSweep::take(const Cavities& cavities) {
  return {interfaces_.take(cavities), meetings_.take(cavities)};
}

}  // namespace mw::audit
