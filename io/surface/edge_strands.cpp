// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Edges of a shell that more than two facets share, and which of these facets belong together.
#include "io/surface/edge_strands.h"

#include <algorithm>

#include "io/file/external_sort.h"

namespace mw::io {
namespace {

constexpr std::size_t kSortBytes = 8 << 20;

/// Facets at an edge: third corner, and whether the facet runs along the edge as its rows ascend.
using EdgeFacets = std::map<std::uint64_t, bool>;
using SharedEdges = std::map<EdgeRows, EdgeFacets>;

/// Records of one edge after the other: its two rows, and two more numbers.
using EdgeRecords = ExternalSort<4>;

EdgeRows edge_of(std::uint64_t a, std::uint64_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// Calls visit(edge, its records) on every edge, ascending.  Memory: the records of one.
template <class Visit>
void each_edge(EdgeRecords& records, Visit visit) {
  std::vector<EdgeRecords::Record> same;
  const auto close = [&] {
    if (!same.empty()) visit(EdgeRows{same[0][0], same[0][1]}, same);
    same.clear();
  };
  records.each([&](const EdgeRecords::Record& record) {
    if (!same.empty() && (record[0] != same[0][0] || record[1] != same[0][1])) close();
    same.push_back(record);
  });
  close();
}

SharedEdges find_shared_edges(const SurfaceSource& source, const ShellPlan& plan) {
  EdgeRecords records(source.folder, kSortBytes);
  for_each_facet(source.mesh, plan, [&](const Triangle& rows) {
    for (std::size_t i = 0; i < 3; ++i) {
      const EdgeRows edge = edge_of(rows[i], rows[(i + 1) % 3]);
      const std::uint64_t forward = rows[i] == edge[0] ? 1 : 0;
      records.add({edge[0], edge[1], rows[(i + 2) % 3], forward});
    }
  });
  SharedEdges shared;
  each_edge(records, [&](const EdgeRows& edge, const std::vector<EdgeRecords::Record>& facets) {
    const auto forward = std::count_if(facets.begin(), facets.end(),
                                       [](const auto& record) { return record[3] == 1; });
    if (forward <= 1 && std::ssize(facets) - forward <= 1) return;
    for (const auto& record : facets) shared[edge].emplace(record[2], record[3] == 1);
  });
  return shared;
}

/// Tells most edges that are not shared from those that are, in fixed memory.
class EdgeFilter {
 public:
  void insert(const EdgeRows& edge) { bits_[slot(edge)] = true; }
  [[nodiscard]] bool may_have(const EdgeRows& edge) const { return bits_[slot(edge)]; }

 private:
  static constexpr unsigned kBits = 23;

  [[nodiscard]] static std::size_t slot(const EdgeRows& edge) {
    const std::uint64_t mixed = (edge[0] * 0x9e3779b97f4a7c15ULL + edge[1]) * 0xd6e8feb86659fd93ULL;
    return mixed >> (64 - kBits);
  }

  std::vector<bool> bits_ = std::vector<bool>(std::size_t{1} << kBits);
};

/// For each tet of the label that may be at a shared edge, the edge and the other two corners.
void add_tets(GroupedMesh& mesh, Label label, const SharedEdges& shared, EdgeRecords& records) {
  EdgeFilter filter;
  for (const auto& [edge, facets] : shared) filter.insert(edge);
  const RowRange tets = mesh.label_tets()[label];
  for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
    const TetRows tet = mesh.tet(t);
    for (const auto& [a, b] : kTetEdges) {
      const EdgeRows edge = edge_of(tet[a], tet[b]);
      if (!filter.may_have(edge)) continue;
      EdgeRows others{};
      std::size_t count = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        if (i != a && i != b) others[count++] = tet[i];
      }
      records.add({edge[0], edge[1], others[0], others[1]});
    }
  }
}

/// Corners around an edge, joined where a tet of the label has both.
using Link = std::map<std::uint64_t, std::vector<std::uint64_t>>;

/// The other end of the fan of tets that begins at the facet of this corner.
std::uint64_t far_end(const Link& link, std::uint64_t corner) {
  std::uint64_t before = kNoCorner;
  for (;;) {
    const std::vector<std::uint64_t>& next = link.at(corner);
    const auto on = std::find_if(next.begin(), next.end(),
                                 [&](std::uint64_t other) { return other != before; });
    if (on == next.end()) return corner;
    before = std::exchange(corner, *on);
  }
}

void add_facet(const EdgeFacets& facets, std::uint64_t corner, Strand& strand) {
  const auto found = facets.find(corner);
  if (found == facets.end()) return;  // the fan ends at something that is not in the shell
  (found->second ? strand.forward : strand.backward) = corner;
}

std::vector<Strand> strands_of(const EdgeFacets& facets, const Link& link) {
  std::vector<Strand> strands;
  for (const auto& [corner, forward] : facets) {
    if (!forward) continue;
    strands.push_back({.forward = corner});
    add_facet(facets, far_end(link, corner), strands.back());
    strands.back().forward = corner;
  }
  for (const auto& [corner, forward] : facets) {
    const auto taken = [c = corner](const Strand& strand) { return strand.backward == c; };
    if (!forward && std::none_of(strands.begin(), strands.end(), taken)) {
      strands.push_back({.backward = corner});
    }
  }
  return strands;
}

}  // namespace

EdgeStrands find_strands(const SurfaceSource& source, const ShellPlan& plan) {
  EdgeStrands strands;
  const SharedEdges shared = find_shared_edges(source, plan);
  if (shared.empty()) return strands;
  EdgeRecords tets(source.folder, kSortBytes);
  add_tets(source.mesh, inside_of(source.mesh, plan.parts.front()), shared, tets);
  each_edge(tets, [&](const EdgeRows& edge, const std::vector<EdgeRecords::Record>& around) {
    const auto found = shared.find(edge);
    if (found == shared.end()) return;
    Link link;
    for (const auto& record : around) {
      link[record[2]].push_back(record[3]);
      link[record[3]].push_back(record[2]);
    }
    strands.emplace(edge, strands_of(found->second, link));
  });
  return strands;
}

}  // namespace mw::io
