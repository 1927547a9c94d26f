// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The two ends at which the job of a deck holds a mesh and pulls it.
#include "io/mesh/grouped/facet_nodes.h"

#include <cmath>

namespace mw::io {
namespace {

bool has_side(const GroupedMesh& mesh, Side side) {
  return std::ranges::any_of(mesh.facet_groups(),
                             [side](const FacetGroup& group) { return group.side == side; });
}

}  // namespace

DeckEnds::DeckEnds(GroupedMesh& mesh)
    : are_sides_(has_side(mesh, Side::kZMin) && has_side(mesh, Side::kZMax)) {
  constexpr double kPulled = 0.01, kHeld = 0.05;
  const Position& edge = mesh.box().edges[2];
  const double length = std::hypot(edge[0], edge[1], edge[2]);
  for (std::size_t k = 0; k < 3; ++k) direction_[k] = length > 0 ? edge[k] / length : 0;
  double lo = 0, hi = 0;
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
    const double at = along(mesh.node(row));
    lo = row == 0 ? at : std::min(lo, at);
    hi = row == 0 ? at : std::max(hi, at);
  }
  low_ = lo + kHeld * (hi - lo);
  high_ = hi - kHeld * (hi - lo);
  for (std::size_t k = 0; k < 3; ++k) shift_[k] = kPulled * (hi - lo) * direction_[k];
}

double DeckEnds::along(const Position& node) const {
  return node[0] * direction_[0] + node[1] * direction_[1] + node[2] * direction_[2];
}

}  // namespace mw::io
