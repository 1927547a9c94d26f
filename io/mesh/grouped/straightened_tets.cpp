// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Shortens moves in rounds over all tets, until none is spoilt.
#include "io/mesh/grouped/curved_nodes.h"

#include <algorithm>

#include "kernels/curve/quadratic.h"
#include "kernels/quality/halved_tet.h"
#include "kernels/quality/quality.h"

namespace mw::io {
namespace {

constexpr std::array<double, 4> kShares{1, 0.5, 0.25, 0};

// Moves may make the worst of a tet's straight parts worse by a quarter; the second is the radius
// ratio from which on a part is good enough whatever it was (bench/parameters.md, "Cut tets").
constexpr double kKeptShare = 0.75;
constexpr double kAlwaysGood = 0.2;

Vec3 to_vector(const Position& p) {
  return {p[0], p[1], p[2]};
}

TetEdges edges_of(const QuadraticTet& tet, const std::array<std::size_t, 4>& corners) {
  const Vec3& at = tet[corners[0]];
  return {tet[corners[1]] - at, tet[corners[2]] - at, tet[corners[3]] - at};
}

class Straightening {
 public:
  Straightening(GroupedMesh& mesh, PagedArray<NodeMove> moves, bool has_straight_parts)
      : mesh_(mesh), moves_(std::move(moves)), has_straight_parts_(has_straight_parts) {
    const auto& promises = mesh.header().record.promises;
    if (!promises) return;
    const int cuts = has_straight_parts ? promises->halvings + 1 : 0;
    floor_ = halved_floor(promises->quality_floor, cuts);
  }

  PagedArray<Position> run(const std::filesystem::path& folder) {
    for (bool is_first = true; hold_back(is_first); is_first = false) shorten();
    PagedArray<Position> out(folder, mesh_.node_count());
    for (std::uint64_t v = 0; v < mesh_.vertex_count(); ++v) {
      out.change(v, [&, at = place(v)](Position& p) { p = {at[0], at[1], at[2]}; });
    }
    for (std::uint64_t number = 0; number < mesh_.tet_count(); ++number) {
      const NodeRows rows = mesh_.tet_nodes(number);
      const QuadraticTet tet = nodes_of(rows, true);
      for (std::size_t i = 4; i < tet.size(); ++i) {
        out.change(rows.begin()[i], [&](Position& p) { p = {tet[i][0], tet[i][1], tet[i][2]}; });
      }
    }
    return out;
  }

 private:
  [[nodiscard]] Vec3 place(std::uint64_t row) {
    const NodeMove node = moves_.get(row);
    return to_vector(mesh_.node(row)) + kShares[node.shorter] * to_vector(node.move);
  }

  /// Returns the places of the nodes, before the moves or after them.
  [[nodiscard]] QuadraticTet nodes_of(const NodeRows& rows, bool are_moved) {
    QuadraticTet out;
    for (std::size_t i = 0; i < 4; ++i) {
      out[i] = are_moved ? place(rows.begin()[i]) : to_vector(mesh_.node(rows.begin()[i]));
    }
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const std::uint64_t row = rows.begin()[4 + e];
      const auto [a, b] = kTetEdges[e];
      // All tets at an edge take its ends in one order, so that rounding is the same.
      const bool ascends = rows.begin()[a] < rows.begin()[b];
      const Vec3 &low = out[ascends ? a : b], &high = out[ascends ? b : a];
      const bool has_own = are_moved && moves_.get(row).has_own;
      out[4 + e] = has_own ? place(row) : Vec3(low + (high - low) / 2);
    }
    return out;
  }

  /// Marks the node that goes farthest in each spoilt tet; returns true if there was one.
  bool hold_back(bool is_first) {
    bool found = false;
    for (std::uint64_t number = 0; number < mesh_.tet_count(); ++number) {
      const NodeRows rows = mesh_.tet_nodes(number);
      if (!is_asked(rows, is_first) || is_sound(rows)) continue;
      moves_.change(farthest_of(rows), [](NodeMove& node) { node.is_held_back = true; });
      found = true;
    }
    return found;
  }

  /// True if a node of the tet moves, and one was changed in the last round or this is the first.
  [[nodiscard]] bool is_asked(const NodeRows& rows, bool is_first) {
    bool moves = false, changed = is_first;
    for (const std::uint64_t row : rows) {
      const NodeMove node = moves_.get(row);
      moves = moves || (node.shorter < 3 && node.move != Position{});
      changed = changed || node.was_changed;
    }
    return moves && changed;
  }

  /// Returns the node that goes farthest, among equal ones that of the first row.
  [[nodiscard]] std::uint64_t farthest_of(const NodeRows& rows) {
    std::uint64_t out = *rows.begin();
    double most = -1;
    for (const std::uint64_t row : rows) {
      const NodeMove node = moves_.get(row);
      const double length = kShares[node.shorter] * to_vector(node.move).norm();
      if (length < most || (length == most && row > out)) continue;
      most = length;
      out = row;
    }
    return out;
  }

  [[nodiscard]] bool is_sound(const NodeRows& rows) {
    const QuadraticTet straight = nodes_of(rows, false), tet = nodes_of(rows, true);
    const TetEdges before = edges_of(straight, {0, 1, 2, 3});
    const double volume6 = before.a.cross(before.b).dot(before.c);
    if (has_straight_parts_) return has_sound_parts(straight, tet, kLeastJacobian / 8 * volume6);
    return least_jacobian(tet) >= kLeastJacobian * volume6 &&
           least_part(tet) >= kLeastJacobian / 8 * volume6 &&
           reaches_ratio(edges_of(tet, {0, 1, 2, 3}), floor_);
  }

  [[nodiscard]] bool has_sound_parts(const QuadraticTet& straight, const QuadraticTet& tet,
                                     double least_volume6) const {
    const double ratio = std::max(floor_, std::min(kAlwaysGood, kKeptShare * worst_of(straight)));
    for (const auto& part : halved_tet(tet)) {
      const TetEdges edges = edges_of(tet, part);
      if (edges.a.cross(edges.b).dot(edges.c) < least_volume6) return false;
      if (!reaches_ratio(edges, ratio)) return false;
    }
    return true;
  }

  [[nodiscard]] static double worst_of(const QuadraticTet& tet) {
    double out = 1;
    for (const auto& part : halved_tet(tet)) {
      out = std::min(out, radius_ratio(edges_of(tet, part)));
    }
    return out;
  }

  void shorten() {
    for (std::uint64_t row = 0; row < moves_.size(); ++row) {
      const NodeMove node = moves_.get(row);
      if (!node.is_held_back && !node.was_changed) continue;
      moves_.change(row, [](NodeMove& n) {
        n.was_changed = n.is_held_back && n.shorter < 3;
        if (n.was_changed) ++n.shorter;
        n.is_held_back = false;
      });
    }
  }

  GroupedMesh& mesh_;
  PagedArray<NodeMove> moves_;
  bool has_straight_parts_ = false;
  double floor_ = 0;
};

}  // namespace

PagedArray<Position> straightened(GroupedMesh& mesh, PagedArray<NodeMove> moves,
                                  const std::filesystem::path& folder, bool has_straight_parts) {
  return Straightening(mesh, std::move(moves), has_straight_parts).run(folder);
}

}  // namespace mw::io
