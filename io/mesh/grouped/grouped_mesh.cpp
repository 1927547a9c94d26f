// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Looks things up in a grouped mesh, and streams it into a sink.
#include "io/mesh/grouped/grouped_mesh.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/tet_nodes.h"

namespace mw::io {

GroupedMesh::GroupedMesh(const std::filesystem::path& folder)
    : folder_(folder),
      tets_(folder, 0),
      values_(folder, 0),
      facets_(folder),
      facet_groups_(folder),
      wedges_(folder),
      edges_(folder),
      middles_(folder) {}

Position GroupedMesh::node(std::uint64_t row) {
  if (curved_nodes_ != nullptr) return curved_nodes_->get(row);
  if (row < vertex_count()) return source_->vertex(row);
  const auto [a, b] = edges_[row - vertex_count()];
  const Position p = source_->vertex(a);
  const Position q = source_->vertex(b);
  return {p[0] + (q[0] - p[0]) / 2, p[1] + (q[1] - p[1]) / 2, p[2] + (q[2] - p[2]) / 2};
}

Label GroupedMesh::label_of(std::uint64_t tet) const {
  const auto behind = std::upper_bound(
      label_tets_.begin(), label_tets_.end(), tet,
      [](std::uint64_t number, const RowRange& range) { return number < range.end; });
  return static_cast<Label>(behind - label_tets_.begin());
}

std::array<std::uint64_t, 3> GroupedMesh::facet_middles(const Facet& facet) {
  const TetRows corners = tet(facet.tet);
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

namespace {

/// A point lies on a side of a box when it is within this share of the box's length.
constexpr double kTolerance = 1e-9;

}  // namespace

double share_along(const MeshBox& box, std::size_t axis, const Position& p) {
  double along = 0;
  double length = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    along += box.edges[axis][k] * (p[k] - box.origin[k]);
    length += box.edges[axis][k] * box.edges[axis][k];
  }
  return along / length;
}

Side BoxSides::side_of(const std::array<Position, 3>& corners) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t end = 0; end < 2; ++end) {
      const bool on_side = std::all_of(corners.begin(), corners.end(), [&](const Position& p) {
        return std::abs(share_along(box_, axis, p) - static_cast<double>(end)) <= kTolerance;
      });
      if (on_side) return static_cast<Side>(1 + 2 * axis + end);
    }
  }
  return Side::kOuter;
}

NodeRows GroupedMesh::tet_nodes(std::uint64_t number) {
  NodeRows out;
  out.add(tet(number));
  if (has_middles(element_)) out.add(middles_[number]);
  return out;
}

Facet GroupedMesh::of_second(const Facet& facet) {
  Facet out = facet;
  std::swap(out.tet, out.second_tet);
  std::swap(out.opposite, out.second_opposite);
  const TetRows corners = tet(out.tet);
  for (std::size_t i = 0; i < 3; ++i) out.rows[i] = corners[kTetFacets[out.opposite][i]];
  return out;
}

NodeRows GroupedMesh::facet_nodes(const Facet& facet) {
  NodeRows out;
  out.add(facet.rows);
  if (has_middles(element_)) out.add(facet_middles(facet));
  return out;
}

NodeRows GroupedMesh::wedge_nodes(const Wedge& wedge) {
  NodeRows out;
  out.add(wedge.bottom);
  out.add(wedge.top);
  if (element_ == Element::kTet4) return out;
  out.add(facet_middles({.rows = wedge.bottom, .tet = wedge.bottom_tet}));
  out.add(facet_middles({.rows = wedge.top, .tet = wedge.top_tet}));
  return out;
}

void write_nodes(GroupedMesh& mesh, MeshSink& sink) {
  constexpr std::uint64_t kBatchRows = 4096;
  std::vector<Position> batch;
  for (std::uint64_t at = 0; at < mesh.node_count(); at += batch.size()) {
    batch.resize(std::min(kBatchRows, mesh.node_count() - at));
    for (std::size_t i = 0; i < batch.size(); ++i) batch[i] = mesh.node(at + i);
    sink.write_vertices(batch);
  }
}

}  // namespace mw::io
