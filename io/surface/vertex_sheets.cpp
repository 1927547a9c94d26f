// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which corners of facets at a vertex are one vertex of a surface that is a manifold.
#include "io/surface/vertex_sheets.h"

#include <algorithm>

#include "io/file/scratch/external_sort.h"

namespace mw::io {
namespace {

/// The facets at an edge, by their third corner: whether each runs along it as its rows ascend.
using EdgeFacets = std::map<std::uint64_t, bool>;
using SharedEdges = std::map<EdgeRows, EdgeFacets>;

/// Records of edges, each with the edge's two rows and two more numbers.
using EdgeRecords = ExternalSort<4>;

EdgeRows edge_of(std::uint64_t a, std::uint64_t b) {
  return {std::min(a, b), std::max(a, b)};
}

SharedEdges find_shared_edges(const SurfaceSource& source, const ShellPlan& plan) {
  EdgeRecords records(source.folder, kSurfaceSortBytes);
  for_each_facet(source.mesh, plan, [&](const Triangle& rows) {
    for (std::size_t i = 0; i < 3; ++i) {
      const EdgeRows edge = edge_of(rows[i], rows[(i + 1) % 3]);
      const std::uint64_t forward = rows[i] == edge[0] ? 1 : 0;
      records.add({edge[0], edge[1], rows[(i + 2) % 3], forward});
    }
  });
  SharedEdges shared;
  records.each_group<2>([&](std::span<const EdgeRecords::Record> facets) {
    const auto forward = std::count_if(facets.begin(), facets.end(),
                                       [](const auto& record) { return record[3] == 1; });
    if (forward <= 1 && std::ssize(facets) - forward <= 1) return;
    for (const auto& [low, high, third, runs_forward] : facets) {
      shared[{low, high}].emplace(third, runs_forward == 1);
    }
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

/// Adds, for each tet of the label that may be at a shared edge, the edge and its other corners.
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

/// Returns the other end of the fan of tets that begins at the facet of this corner.
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
constexpr std::uint64_t kUnknown = ~std::uint64_t{0};

/// A facet as seen from one of its corners: it leaves along the edge to `to`, and comes back along
/// that from `from`.
struct StarCorner {
  std::uint64_t to = 0;
  std::uint64_t from = 0;
  std::uint64_t corner = 0;
  std::uint64_t sheet = 0;
};

/// All facets at one vertex, ascending by `to`.
struct Star {
  std::uint64_t row = 0;
  std::vector<StarCorner> corners;
};

/// Returns the corner of the facet that leaves along the edge to `to` and has `from` as third
/// corner, or, if that is kNoCorner, of the first that leaves there; null when there is none.
StarCorner* leaving(Star& star, std::uint64_t to, std::uint64_t from) {
  auto at = std::lower_bound(star.corners.begin(), star.corners.end(), to,
                             [](const StarCorner& c, std::uint64_t row) { return c.to < row; });
  for (; at != star.corners.end() && at->to == to; ++at) {
    if (from == kNoCorner || at->from == from) return &*at;
  }
  return nullptr;
}

/// Returns the facet that follows around the vertex, the partner at the edge by which `at` comes
/// back; null when there is none.
StarCorner* next_corner(Star& star, const StarCorner& at, const EdgeStrands& strands) {
  const auto shared = strands.find({std::min(star.row, at.from), std::max(star.row, at.from)});
  if (shared == strands.end()) return leaving(star, at.from, kNoCorner);
  const bool comes_back = star.row < at.from;  // against the order of rows
  for (const Strand& strand : shared->second) {
    if ((comes_back ? strand.backward : strand.forward) != at.to) continue;
    const std::uint64_t partner = comes_back ? strand.forward : strand.backward;
    return partner == kNoCorner ? nullptr : leaving(star, at.from, partner);
  }
  return nullptr;
}

/// Gives a sheet to the corners that follow around the vertex from `first` on and have none.
void name_sheet(Star& star, StarCorner& first, const EdgeStrands& strands) {
  std::vector<StarCorner*> fan;
  std::uint64_t min = kUnknown;
  for (StarCorner* at = &first; at != nullptr && at->sheet == kUnknown;
       at = next_corner(star, *at, strands)) {
    at->sheet = first.corner;
    min = std::min(min, at->corner);
    fan.push_back(at);
  }
  for (StarCorner* const at : fan) at->sheet = min;
}

/// Finds the sheets of a star, each of which has the number of the least corner in it.
void find_sheets(Star& star, const EdgeStrands& strands) {
  std::vector<bool> begins(star.corners.size(), true);
  for (StarCorner& corner : star.corners) {
    corner.sheet = kUnknown;
    const StarCorner* next = next_corner(star, corner, strands);
    if (next != nullptr) begins[static_cast<std::size_t>(next - star.corners.data())] = false;
  }
  // Open fans come first, from their beginning on, then those that are closed.
  for (const bool open : {true, false}) {
    for (std::size_t i = 0; i < star.corners.size(); ++i) {
      if (begins[i] == open) name_sheet(star, star.corners[i], strands);
    }
  }
}

/// The stars of the ends of shared edges, by row.
using Stars = std::map<std::uint64_t, Star>;

/// Returns the sheet of a strand's facets at one end of the edge.
std::uint64_t sheet_at(Star& star, std::uint64_t other_end, const Strand& strand) {
  const bool ascends = star.row < other_end;
  // The facet that leaves along the edge, or else the one that comes back.
  const std::uint64_t leaves = ascends ? strand.forward : strand.backward;
  const StarCorner* const at =
      leaves != kNoCorner ? leaving(star, other_end, leaves)
                          : leaving(star, ascends ? strand.backward : strand.forward, other_end);
  return at == nullptr ? kUnknown : at->sheet;  // there is none where a tet has a corner twice
}

/// Whether two strands of one edge would be one edge of more than two facets.
bool clash(Stars& stars, const EdgeRows& edge, const Strand& one, const Strand& other) {
  const bool two_rims = (one.forward == kNoCorner && other.backward == kNoCorner) ||
                        (one.backward == kNoCorner && other.forward == kNoCorner);
  if (two_rims) return false;  // two facets in opposite directions
  for (std::size_t end = 0; end < 2; ++end) {
    Star& star = stars.at(edge[end]);
    if (sheet_at(star, edge[1 - end], one) != sheet_at(star, edge[1 - end], other)) return false;
  }
  return true;
}

/// Lets strands that clash change partners.  This splits the sheet at either end in two, so that
/// strands that do not clash never will.
void part_clashes(Stars& stars, EdgeStrands& strands) {
  for (auto& [edge, here] : strands) {
    for (std::size_t i = 0; i < here.size(); ++i) {
      for (std::size_t j = i + 1; j < here.size(); ++j) {
        if (!clash(stars, edge, here[i], here[j])) continue;
        std::swap(here[i].backward, here[j].backward);
        for (const std::uint64_t row : edge) find_sheets(stars.at(row), strands);
      }
    }
  }
}

void pass_on(const Star& star, const std::function<void(const SheetCorner&)>& visit) {
  for (const StarCorner& corner : star.corners) visit({star.row, corner.sheet, corner.corner});
}

/// Records of a corner: its row, the next corner's row, the third corner's row, and its number.
using Corners = ExternalSort<4>;

void add_corners(const SurfaceSource& source, const ShellPlan& plan, Corners& corners) {
  std::uint64_t corner = 0;
  for_each_facet(source.mesh, plan, [&](const Triangle& rows) {
    for (std::size_t i = 0; i < 3; ++i) {
      corners.add({rows[i], rows[(i + 1) % 3], rows[(i + 2) % 3], corner++});
    }
  });
}

/// Calls use(star) on every star, ascending by row; its sheets are not known yet.
template <class Use>
void each_star(Corners& corners, Use use) {
  corners.each_group<1>([&](std::span<const Corners::Record> same) {
    Star star{.row = same[0][0], .corners = {}};
    for (const auto& [row, to, from, corner] : same) {
      star.corners.push_back({.to = to, .from = from, .corner = corner});
    }
    use(star);
  });
}

}  // namespace

EdgeStrands find_strands(const SurfaceSource& source, const ShellPlan& plan) {
  EdgeStrands strands;
  const SharedEdges shared = find_shared_edges(source, plan);
  if (shared.empty()) return strands;
  EdgeRecords tets(source.folder, kSurfaceSortBytes);
  add_tets(source.mesh, inside_of(source.mesh, plan.parts.front()), shared, tets);
  tets.each_group<2>([&](std::span<const EdgeRecords::Record> around) {
    const auto found = shared.find({around[0][0], around[0][1]});
    if (found == shared.end()) return;
    Link link;
    for (const auto& record : around) {
      link[record[2]].push_back(record[3]);
      link[record[3]].push_back(record[2]);
    }
    strands.emplace(found->first, strands_of(found->second, link));
  });
  return strands;
}

void each_sheet_corner(const SurfaceSource& source, const ShellPlan& plan,
                       const std::function<void(const SheetCorner&)>& visit) {
  EdgeStrands strands = find_strands(source, plan);
  Stars held;
  for (const auto& [edge, here] : strands) {
    for (const std::uint64_t row : edge) held[row].row = row;
  }
  Corners corners(source.folder, kSurfaceSortBytes);
  add_corners(source, plan, corners);
  each_star(corners, [&](Star& star) {
    find_sheets(star, strands);
    const auto at_shared_edge = held.find(star.row);
    if (at_shared_edge == held.end()) {
      pass_on(star, visit);
    } else {
      at_shared_edge->second = star;
    }
  });
  part_clashes(held, strands);
  for (const auto& [row, star] : held) pass_on(star, visit);
}

}  // namespace mw::io
