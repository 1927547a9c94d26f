// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Shortens moves in rounds over all tets, until none is spoilt.
#include "io/mesh/grouped/straightened_tets.h"

#include "io/mesh/grouped/curved_nodes.h"
#include "kernels/curve/quadratic_tet.h"
#include "kernels/quality/quality.h"

namespace mw::io {
namespace {

constexpr std::array<double, 4> kShares{1, 0.5, 0.25, 0};

Vec3 to_vector(const Position& p) {
  return {p[0], p[1], p[2]};
}

class Straightening {
 public:
  Straightening(GroupedMesh& mesh, PagedArray<NodeMove> moves)
      : mesh_(mesh), moves_(std::move(moves)) {
    const auto& promises = mesh.header().record.promises;
    if (promises) floor_ = promises->quality_floor;
  }

  PagedArray<Position> run(const std::filesystem::path& folder) {
    for (bool is_first = true; hold_back(is_first); is_first = false) shorten();
    PagedArray<Position> out(folder, mesh_.node_count());
    for (std::uint64_t v = 0; v < mesh_.vertex_count(); ++v) {
      out.change(v, [&, at = place(v)](Position& p) { p = {at[0], at[1], at[2]}; });
    }
    for (std::uint64_t number = 0; number < mesh_.tet_count(); ++number) {
      const NodeRows rows = mesh_.tet_nodes(number);
      const QuadraticTet tet = moved(rows);
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

  [[nodiscard]] QuadraticTet moved(const NodeRows& rows) {
    QuadraticTet out;
    for (std::size_t i = 0; i < 4; ++i) out[i] = place(rows.begin()[i]);
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const std::uint64_t row = rows.begin()[4 + e];
      const auto [a, b] = kTetEdges[e];
      // All tets at an edge take its ends in one order, so that rounding is the same.
      const bool ascends = rows.begin()[a] < rows.begin()[b];
      const Vec3 &low = out[ascends ? a : b], &high = out[ascends ? b : a];
      out[4 + e] = moves_.get(row).has_own ? place(row) : Vec3(low + (high - low) / 2);
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
    const Vec3 at = to_vector(mesh_.node(rows.begin()[0]));
    TetEdges straight{to_vector(mesh_.node(rows.begin()[1])) - at,
                      to_vector(mesh_.node(rows.begin()[2])) - at,
                      to_vector(mesh_.node(rows.begin()[3])) - at};
    const double volume6 = straight.a.cross(straight.b).dot(straight.c);
    const QuadraticTet tet = moved(rows);
    const TetEdges corners{tet[1] - tet[0], tet[2] - tet[0], tet[3] - tet[0]};
    return least_jacobian(tet) >= kLeastJacobian * volume6 &&
           least_part(tet) >= kLeastJacobian / 8 * volume6 && reaches_ratio(corners, floor_);
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
  double floor_ = 0;
};

}  // namespace

PagedArray<Position> straightened(GroupedMesh& mesh, PagedArray<NodeMove> moves,
                                  const std::filesystem::path& folder) {
  return Straightening(mesh, std::move(moves)).run(folder);
}

}  // namespace mw::io
