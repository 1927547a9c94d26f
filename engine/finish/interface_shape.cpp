// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Two external sorts: triangles, then edges of those between two labels.
#include "engine/finish/interface_shape.h"

#include <algorithm>
#include <array>

#include "io/file/scratch/external_sort.h"
#include "kernels/core/vector3.h"

namespace mw::engine {
namespace {

using io::Position;
using FaceRecord = std::array<std::uint64_t, 4>;
/// Two ascending rows; the third row of the triangle, doubled, and odd when its wing is turned; and
/// the two labels.
using EdgeRecord = std::array<std::uint64_t, 5>;

std::array<std::uint64_t, 3> rows_of(const FaceRecord& face) {
  return {face[0], face[1], face[2] >> 1};
}

/// Adds the four triangles of a tet: three ascending rows, and the label of the tet.  The last row
/// is doubled, and odd when the triangle's normal points out of the tet.
void add_faces(io::ScratchMesh& mesh, const io::TetRows& tet, RawLabel label,
               io::ExternalSort<4>& faces) {
  io::TetRows rows = tet;
  std::sort(rows.begin(), rows.end());
  const auto [a, b, c, d] = rows;
  const auto [at_a, at_b, at_c, at_d] = mesh.corners(rows);
  // The normal of a b c points at d, into the tet, when that is positive; with each swap it turns.
  const std::uint64_t positive = mw::volume6(at_a, at_b, at_c, at_d) > 0 ? 1 : 0;
  const std::uint64_t negative = 1 - positive;
  faces.add({a, b, c << 1 | negative, label});
  faces.add({a, b, d << 1 | positive, label});
  faces.add({a, c, d << 1 | negative, label});
  faces.add({b, c, d << 1 | positive, label});
}

/// Sorts; calls visit(first, second) for the groups of exactly two records whose keys agree.
template <std::size_t N, typename Key, typename Visit>
void each_pair(io::ExternalSort<N>& records, Key key, Visit visit) {
  std::array<std::array<std::uint64_t, N>, 2> group{};
  std::size_t count = 0;
  const auto close = [&] {
    if (count == 2) visit(group[0], group[1]);
    count = 0;
  };
  records.each([&](const auto& record) {
    if (count > 0 && key(record) != key(group[0])) close();
    if (count < 2) group[count] = record;
    ++count;
  });
  close();
}

/// Adds the edges of a triangle between two labels.
void add_edges(const FaceRecord& one, const FaceRecord& other, io::ExternalSort<5>& edges) {
  const auto [a, b, c] = rows_of(one);
  const FaceRecord& low = one[3] < other[3] ? one : other;
  const FaceRecord& high = one[3] < other[3] ? other : one;
  const std::uint64_t out = low[2] & 1;
  const std::uint64_t in = 1 - out;
  edges.add({a, b, c << 1 | in, low[3], high[3]});
  edges.add({b, c, a << 1 | in, low[3], high[3]});
  edges.add({a, c, b << 1 | out, low[3], high[3]});
}

}  // namespace

audit::ShapeReport interface_shape(io::ScratchMesh& mesh, std::size_t sort_bytes,
                                   const std::function<void()>& between) {
  io::ExternalSort<4> faces(mesh.folder(), sort_bytes);
  mesh.each_tet_batch([&](const io::TetBatch& batch) {
    between();
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      add_faces(mesh, batch.tets[t], batch.labels[t], faces);
    }
  });
  audit::ShapeMeter meter;
  io::ExternalSort<5> edges(mesh.folder(), sort_bytes);
  each_pair(faces, rows_of, [&](const FaceRecord& one, const FaceRecord& other) {
    if (one[3] == other[3]) return;
    const auto [a, b, c] = rows_of(one);
    meter.add_triangle(mesh.vertex(a), mesh.vertex(b), mesh.vertex(c));
    add_edges(one, other, edges);
  });
  const auto edge_of = [](const EdgeRecord& e) { return std::array{e[0], e[1]}; };
  each_pair(edges, edge_of, [&](const EdgeRecord& one, const EdgeRecord& other) {
    if (one[3] != other[3] || one[4] != other[4]) return;
    meter.add_edge(mesh.vertex(one[0]), mesh.vertex(one[1]),
                   {mesh.vertex(one[2] >> 1), (one[2] & 1) != 0},
                   {mesh.vertex(other[2] >> 1), (other[2] & 1) != 0});
  });
  return meter.report();
}

}  // namespace mw::engine
