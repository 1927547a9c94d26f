// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/oracle/hanging_parts.h"

#include <algorithm>

namespace mw::audit::test {
namespace {

std::vector<std::set<std::uint64_t>> faces_of(const TetRow& tet) {
  std::vector<std::set<std::uint64_t>> out;
  for (const std::uint64_t left_out : tet) {
    std::set<std::uint64_t> face(tet.begin(), tet.end());
    face.erase(left_out);
    out.push_back(face);
  }
  return out;
}

bool has_all(const std::set<std::uint64_t>& set, const std::set<std::uint64_t>& of) {
  return std::includes(set.begin(), set.end(), of.begin(), of.end());
}

std::size_t count_sets(const std::map<std::size_t, std::size_t>& sets) {
  std::set<std::size_t> numbers;
  for (const auto& [tet, set] : sets) numbers.insert(set);
  return numbers.size();
}

/// Makes two sets one.
void join(std::map<std::size_t, std::size_t>& sets, std::size_t one, std::size_t other) {
  const std::size_t from = sets.at(other), to = sets.at(one);
  for (auto& [tet, set] : sets) set = set == from ? to : set;
}

}  // namespace

std::map<std::size_t, std::size_t> sets_joined_by_faces(const std::vector<TetRow>& tets,
                                                        const std::set<std::size_t>& among,
                                                        const std::set<std::uint64_t>& common,
                                                        const Joins& joins) {
  std::map<std::set<std::uint64_t>, std::vector<std::size_t>> at_face;
  for (const std::size_t t : among) {
    for (const auto& face : faces_of(tets[t])) {
      if (has_all(face, common)) at_face[face].push_back(t);
    }
  }
  std::map<std::size_t, std::size_t> out;
  for (const std::size_t first : among) {
    if (out.contains(first)) continue;
    std::vector<std::size_t> front{first};
    out[first] = first;
    while (!front.empty()) {
      const std::size_t tet = front.back();
      front.pop_back();
      for (const auto& face : faces_of(tets[tet])) {
        const auto there = at_face.find(face);
        if (there == at_face.end()) continue;
        for (const std::size_t next : there->second) {
          if (out.contains(next) || (joins && !joins(tet, next))) continue;
          out[next] = first;
          front.push_back(next);
        }
      }
    }
  }
  return out;
}

std::map<std::uint64_t, std::set<std::size_t>> stars_of(const std::vector<TetRow>& tets,
                                                        const std::set<std::size_t>& among) {
  std::map<std::uint64_t, std::set<std::size_t>> out;
  for (const std::size_t t : among) {
    for (const std::uint64_t row : tets[t]) out[row].insert(t);
  }
  return out;
}

Hinges hinges_of(const std::vector<TetRow>& tets, const std::set<std::size_t>& among) {
  Hinges out;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::set<std::size_t>> rings;
  for (const std::size_t t : among) {
    for (const std::uint64_t a : tets[t]) {
      for (const std::uint64_t b : tets[t]) {
        if (a < b) rings[{a, b}].insert(t);
      }
    }
  }
  for (const auto& [edge, ring] : rings) {
    const auto fans = sets_joined_by_faces(tets, ring, {edge.first, edge.second});
    if (count_sets(fans) > 1) out.edges.insert(edge);
  }
  for (const auto& [row, star] : stars_of(tets, among)) {
    auto sets = sets_joined_by_faces(tets, star, {row});
    for (const auto& edge : out.edges) {
      if (edge.first != row && edge.second != row) continue;
      const auto& ring = rings.at(edge);
      for (const std::size_t tet : ring) join(sets, *ring.begin(), tet);
    }
    if (count_sets(sets) > 1) out.vertices.insert(row);
  }
  return out;
}

}  // namespace mw::audit::test
