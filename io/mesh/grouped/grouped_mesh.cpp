// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Looking things up in a grouped mesh.
#include "io/mesh/grouped/grouped_mesh.h"

#include <algorithm>

namespace mw::io {

GroupedMesh::GroupedMesh(const std::filesystem::path& folder)
    : vertices_(folder), tets_(folder), facets_(folder), edges_(folder), middles_(folder) {}

Position GroupedMesh::node(std::uint64_t row) {
  if (row < vertices_.size()) return vertices_[row];
  const auto [a, b] = edges_[row - vertices_.size()];
  const Position p = vertices_[a];
  const Position q = vertices_[b];
  return {p[0] + (q[0] - p[0]) / 2, p[1] + (q[1] - p[1]) / 2, p[2] + (q[2] - p[2]) / 2};
}

Label GroupedMesh::label_of(std::uint64_t tet) const {
  const auto behind = std::upper_bound(
      label_tets_.begin(), label_tets_.end(), tet,
      [](std::uint64_t number, const RowRange& range) { return number < range.end; });
  return static_cast<Label>(behind - label_tets_.begin());
}

std::array<std::uint64_t, 3> GroupedMesh::facet_middles(const Facet& facet) {
  const TetRows corners = tets_[facet.tet];
  const std::array<std::uint64_t, 6> rows = middles_[facet.tet];
  std::array<std::uint64_t, 3> out{};
  for (std::size_t side = 0; side < 3; ++side) {
    const std::uint64_t from = facet.rows[side];
    const std::uint64_t to = facet.rows[(side + 1) % 3];
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const std::uint64_t one = corners[kTetEdges[e][0]];
      const std::uint64_t other = corners[kTetEdges[e][1]];
      if ((one == from && other == to) || (one == to && other == from)) out[side] = rows[e];
    }
  }
  return out;
}

}  // namespace mw::io
