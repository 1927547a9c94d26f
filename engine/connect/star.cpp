// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sorts the edges opposite to the vertex to find tets with a common face.
#include "engine/connect/star.h"

#include <algorithm>
#include <numeric>

#include "kernels/core/sort_distinct.h"

namespace mw::engine {
namespace {

/// A face at the vertex: its two other vertices, and the place of the tet.
using StarFace = std::array<std::uint64_t, 3>;

std::vector<StarFace> faces_of(std::span<const StarTet> star) {
  std::vector<StarFace> out;
  for (std::size_t t = 0; t < star.size(); ++t) {
    const auto& [a, b, c] = star[t].others;
    for (const auto& [one, other] : {std::pair(a, b), std::pair(a, c), std::pair(b, c)}) {
      out.push_back({one, other, t});
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Returns the edge to `other` with its tets and two of its fans; an empty one if it has one fan.
SplitEdge fans_at(std::span<const StarTet> star, std::uint64_t other) {
  SplitEdge out{.other = other, .tets = {}};
  for (std::size_t t = 0; t < star.size(); ++t) {
    const auto& others = star[t].others;
    if (std::find(others.begin(), others.end(), other) != others.end()) out.tets.push_back(t);
  }
  std::vector<std::array<std::uint64_t, 2>> apexes;  // the third vertex of a face, place of a tet
  for (std::size_t i = 0; i < out.tets.size(); ++i) {
    for (const std::uint64_t v : star[out.tets[i]].others) {
      if (v != other) apexes.push_back({v, i});
    }
  }
  std::sort(apexes.begin(), apexes.end());
  StarSets fans(out.tets.size());
  for (std::size_t i = 1; i < apexes.size(); ++i) {
    if (apexes[i][0] == apexes[i - 1][0]) fans.unite(apexes[i][1], apexes[i - 1][1]);
  }
  const std::vector<std::size_t> numbers = fans.numbers();
  const auto second = std::find(numbers.begin(), numbers.end(), 1);
  if (second == numbers.end()) return {};
  out.fans = {out.tets.front(), out.tets[static_cast<std::size_t>(second - numbers.begin())]};
  return out;
}

}  // namespace

void each_star_face(std::span<const StarTet> star,
                    const std::function<void(const StarPair&)>& visit) {
  const std::vector<StarFace> faces = faces_of(star);
  for (std::size_t i = 1; i < faces.size(); ++i) {
    const bool is_same = faces[i][0] == faces[i - 1][0] && faces[i][1] == faces[i - 1][1];
    if (is_same) visit({faces[i - 1][2], faces[i][2]});
  }
}

StarSets::StarSets(std::size_t tets) : parent_(tets) {
  std::iota(parent_.begin(), parent_.end(), std::size_t{0});
}

std::size_t StarSets::root(std::size_t tet) const {
  while (parent_[tet] != tet) tet = parent_[tet];
  return tet;
}

void StarSets::unite(std::size_t one, std::size_t other) {
  const auto [low, high] = std::minmax({root(one), root(other)});
  parent_[high] = low;
}

std::vector<std::size_t> StarSets::numbers() const {
  std::vector<std::size_t> out(parent_.size());
  std::size_t next = 0;
  for (std::size_t t = 0; t < out.size(); ++t) {
    const std::size_t first = root(t);
    out[t] = first == t ? next++ : out[first];
  }
  return out;
}

std::size_t StarSets::count() const {
  std::size_t out = 0;
  for (std::size_t t = 0; t < parent_.size(); ++t) out += parent_[t] == t ? 1U : 0U;
  return out;
}

std::vector<SplitEdge> split_edges(std::span<const StarTet> star) {
  std::vector<std::uint64_t> others;
  for (const StarTet& tet : star) others.insert(others.end(), tet.others.begin(), tet.others.end());
  sort_distinct(others);
  std::vector<SplitEdge> out;
  for (const std::uint64_t other : others) {
    SplitEdge edge = fans_at(star, other);
    if (!edge.tets.empty()) out.push_back(std::move(edge));
  }
  return out;
}

}  // namespace mw::engine
