// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where the copies of a vertex go in formats whose readers join equal places.
#include "io/surface/apart_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "kernels/core/elementary.h"
#include "kernels/core/vector3.h"

namespace mw::io {
namespace {

/// Tets of the label at a row: for each its number, and the least number of those that triangles at
/// the row lead to.
using TetParts = std::map<std::uint64_t, std::uint64_t>;

std::uint64_t part_of(TetParts& parts, std::uint64_t tet) {
  for (std::uint64_t next = parts.at(tet); next != tet; next = parts.at(tet)) tet = next;
  return tet;
}

/// Corners of a tet's triangle beside the row, ascending.
using TriangleEnds = std::array<std::uint64_t, 2>;

/// The tets of the label around one row.
class TetStar {
 public:
  void add(std::uint64_t row, std::uint64_t number, const TetRows& tet) {
    parts_[number] = number;
    std::array<std::uint64_t, 3> others{};
    std::size_t count = 0;
    for (const std::uint64_t corner : tet) {
      if (corner != row && count < others.size()) others[count++] = corner;
    }
    if (count < others.size()) return;  // the tet has a corner twice
    others_[number] = others;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(others[i], others[(i + 1) % 3]);
      join(number, tet_at_.try_emplace(TriangleEnds{low, high}, number).first->second);
    }
  }

  /// Returns the part with the tet, by its least tet; a tet that is not here is a part by itself.
  [[nodiscard]] std::uint64_t part(std::uint64_t tet) {
    return parts_.contains(tet) ? part_of(parts_, tet) : tet;
  }

  /// Calls visit(rows) on the other three corners of each tet of a part.
  template <class Visit>
  void each_in(std::uint64_t part, Visit visit) {
    for (const auto& [tet, others] : others_) {
      if (part_of(parts_, tet) == part) visit(others);
    }
  }

 private:
  void join(std::uint64_t one, std::uint64_t other) {
    const std::uint64_t a = part_of(parts_, one), b = part_of(parts_, other);
    parts_.at(std::max(a, b)) = std::min(a, b);
  }

  TetParts parts_;
  std::map<std::uint64_t, std::array<std::uint64_t, 3>> others_;
  std::map<TriangleEnds, std::uint64_t> tet_at_;
};

/// The triangles at a copy, with the vertex itself left out, and a tet of the label behind them.
struct Fan {
  std::vector<std::array<Position, 2>> spans;
  std::uint64_t tet = 0;
};

double height_above(const Position& apex, const Position& a, const Position& b) {
  const double base = norm(minus(b, a));
  return base > 0 ? norm(cross(minus(a, apex), minus(b, apex))) / base : 0;
}

double height_above(const Position& apex, const std::array<Position, 3>& base) {
  const double area2 = norm(cross(minus(base[1], base[0]), minus(base[2], base[0])));
  return area2 > 0 ? std::abs(volume6(apex, base[0], base[1], base[2])) / area2 : 0;
}

Position along(const Position& from, const Position& way, double step) {
  return {from[0] + step * way[0], from[1] + step * way[1], from[2] + step * way[2]};
}

/// Returns a vector of length 1, or along x where the vector has no length.
Position direction_of(const Position& vector) {
  const double length = norm(vector);
  if (!(length > 0) || !std::isfinite(length)) return {1, 0, 0};
  return {vector[0] / length, vector[1] / length, vector[2] / length};
}

/// Returns the sum of the normals, each times its triangle's angle at the vertex.
Position normal_sum(const Position& at, const Fan& fan) {
  Position sum{};
  for (const auto& [a, b] : fan.spans) {
    const Position to_a = minus(a, at), to_b = minus(b, at);
    const Position normal = cross(to_a, to_b);
    const double sine = norm(normal);
    if (sine > 0) sum = along(sum, normal, angle_of(sine, dot(to_a, to_b)) / sine);
  }
  return sum;
}

/// Finds the places of the copies of one row.
class RowPlaces {
 public:
  RowPlaces(const SurfaceSource& source, std::uint64_t row, TetStar& star)
      : source_(source), at_(source.mesh.node(row)), star_(star) {}

  void add(std::uint64_t vertex, Fan fan) { fans_.emplace(vertex, std::move(fan)); }

  void settle(std::map<std::uint64_t, Position>& places) {
    std::map<std::uint64_t, int> fans_of;  // by part
    for (const auto& [vertex, fan] : fans_) ++fans_of[star_.part(fan.tet)];
    for (const auto& [vertex, fan] : fans_) {
      const bool is_alone = fans_of.at(star_.part(fan.tet)) == 1;
      const double share = is_alone ? -1 : 1;
      ways_[vertex] = along({}, direction_of(normal_sum(at_, fan)), share * step(fan, is_alone));
    }
    constexpr double kMaxFactor = 64;
    double factor = 1;
    while (factor < kMaxFactor && !are_apart(factor)) factor *= 2;
    for (const auto& [vertex, way] : ways_) places[vertex] = place(way, factor);
  }

 private:
  [[nodiscard]] double step(const Fan& fan, bool is_alone) {
    constexpr double kShare = 1.0 / 256;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : fan.spans) least = std::min(least, height_above(at_, a, b));
    if (!is_alone) return kShare * least;
    star_.each_in(star_.part(fan.tet), [&](const std::array<std::uint64_t, 3>& rows) {
      std::array<Position, 3> base{};
      for (std::size_t i = 0; i < 3; ++i) base[i] = source_.mesh.node(rows[i]);
      least = std::min(least, height_above(at_, base));
    });
    return kShare * least;
  }

  [[nodiscard]] Position place(const Position& way, double factor) const {
    return minus(along(at_, way, factor), source_.shift);
  }

  /// Returns whether no two copies, nor a copy and the vertex, round to the same place.
  [[nodiscard]] bool are_apart(double factor) const {
    std::set<std::array<float, 3>> taken;
    const auto take = [&](const Position& p) {
      return taken
          .insert({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])})
          .second;
    };
    return std::all_of(ways_.begin(), ways_.end(),
                       [&](const auto& way) { return take(place(way.second, factor)); });
  }

  const SurfaceSource& source_;
  Position at_;
  TetStar& star_;
  std::map<std::uint64_t, Fan> fans_;       ///< by vertex
  std::map<std::uint64_t, Position> ways_;  ///< by vertex: a step
};

using TetStars = std::map<std::uint64_t, TetStar>;

TetStars stars_of(const SurfaceSource& source, Label label, const VertexCopies& copies) {
  TetStars stars;
  for (const auto& [vertex, copy] : copies) stars.try_emplace(copy.row);
  const RowRange tets = source.mesh.label_tets()[label];
  for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
    const TetRows tet = source.mesh.tet(t);
    for (const std::uint64_t row : tet) {
      const auto star = stars.find(row);
      if (star != stars.end()) star->second.add(row, t, tet);
    }
  }
  return stars;
}

/// A facet of a shell, by its number there.
struct ShellFacet {
  Triangle rows{};        ///< with normals as planned
  std::uint64_t tet = 0;  ///< on the side that they point out of
};

class ShellFacets {
 public:
  ShellFacets(GroupedMesh& mesh, const ShellPlan& plan) : mesh_(mesh), plan_(plan) {
    for (const ShellPart& part : plan.parts) {
      begins_.push_back(count_);
      count_ += mesh.facet_groups()[part.group].facets.size();
    }
  }

  [[nodiscard]] ShellFacet operator[](std::uint64_t number) {
    const auto behind = std::upper_bound(begins_.begin(), begins_.end(), number);
    const auto at = static_cast<std::size_t>(behind - begins_.begin()) - 1;
    const ShellPart& part = plan_.parts[at];
    const RowRange facets = mesh_.facet_groups()[part.group].facets;
    const Facet facet = mesh_.facet(facets.begin + (number - begins_[at]));
    ShellFacet out{.rows = facet.rows, .tet = part.turned ? facet.second_tet : facet.tet};
    if (part.turned) std::swap(out.rows[1], out.rows[2]);
    return out;
  }

 private:
  GroupedMesh& mesh_;
  const ShellPlan& plan_;
  std::vector<std::uint64_t> begins_;  ///< by part: the number of its first facet
  std::uint64_t count_ = 0;
};

Fan fan_of(GroupedMesh& mesh, ShellFacets& facets, const VertexCopy& copy) {
  Fan fan;
  for (const std::uint64_t corner : copy.corners) {
    const ShellFacet facet = facets[corner / 3];
    fan.spans.push_back(
        {mesh.node(facet.rows[(corner + 1) % 3]), mesh.node(facet.rows[(corner + 2) % 3])});
    fan.tet = facet.tet;
  }
  return fan;
}

}  // namespace

std::map<std::uint64_t, Position> places_apart(const SurfaceSource& source, const ShellPlan& plan,
                                               const VertexCopies& copies) {
  std::map<std::uint64_t, Position> places;
  if (copies.empty()) return places;
  TetStars stars = stars_of(source, inside_of(source.mesh, plan.parts.front()), copies);
  ShellFacets facets(source.mesh, plan);
  for (auto at = copies.begin(); at != copies.end();) {
    const std::uint64_t row = at->second.row;
    RowPlaces here(source, row, stars.at(row));
    for (; at != copies.end() && at->second.row == row; ++at) {
      here.add(at->first, fan_of(source.mesh, facets, at->second));
    }
    here.settle(places);
  }
  return places;
}

}  // namespace mw::io
