// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An external sort of the edges of triangles between two labels.
#include "engine/finish/interface_shape.h"

#include <algorithm>
#include <span>

#include "io/file/scratch/external_sort.h"

namespace mw::engine {
namespace {

/// Two ascending rows; the third row of the triangle, doubled, and odd when its wing is turned; and
/// the two labels.
using EdgeRecords = io::ExternalSort<5>;

/// Adds the edges of a triangle between two labels.
void add_edges(const io::MeshFacet& facet, EdgeRecords& edges) {
  const auto [a, b, c] = facet.rows;
  const auto [low, high] = std::minmax(
      facet.sides[0], facet.sides[1],
      [](const io::FacetSide& one, const io::FacetSide& other) { return one.label < other.label; });
  const std::uint64_t out = low.points_out;
  const std::uint64_t in = 1 - out;
  edges.add({a, b, c << 1 | in, low.label, high.label});
  edges.add({b, c, a << 1 | in, low.label, high.label});
  edges.add({a, c, b << 1 | out, low.label, high.label});
}

}  // namespace

audit::ShapeReport interface_shape(io::ScratchMesh& mesh, std::size_t sort_bytes,
                                   const std::function<void()>& between) {
  io::ScratchFile& facets = mesh.facets(sort_bytes, between);
  audit::ShapeMeter meter;
  EdgeRecords edges(mesh.folder(), sort_bytes);
  facets.each_batch<io::MeshFacet>([&](std::span<const io::MeshFacet> batch) {
    between();
    for (const io::MeshFacet& facet : batch) {
      if (facet.tets != 2) continue;
      const auto [a, b, c] = facet.rows;
      meter.add_triangle(mesh.vertex(a), mesh.vertex(b), mesh.vertex(c));
      add_edges(facet, edges);
    }
  });
  edges.each_group<2>([&](std::span<const EdgeRecords::Record> sides) {
    if (sides.size() != 2) return;
    const EdgeRecords::Record &one = sides[0], &other = sides[1];
    if (one[3] != other[3] || one[4] != other[4]) return;
    meter.add_edge(mesh.vertex(one[0]), mesh.vertex(one[1]),
                   {mesh.vertex(one[2] >> 1), (one[2] & 1) != 0},
                   {mesh.vertex(other[2] >> 1), (other[2] & 1) != 0});
  });
  return meter.report();
}

}  // namespace mw::engine
