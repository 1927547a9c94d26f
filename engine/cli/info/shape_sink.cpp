// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Two external sorts: triangles, then edges of those between two labels.
#include "engine/cli/info/shape_sink.h"

#include <algorithm>
#include <string>

#include "io/mesh/grouped/grouped_mesh.h"
#include "kernels/core/error.h"
#include "kernels/core/vector3.h"

namespace mw::cli {
namespace {

using io::Position;
using FaceRecord = std::array<std::uint64_t, 4>;
/// Two ascending rows; the third row of the triangle, doubled, and odd when its wing is turned; and
/// the two labels.
using EdgeRecord = std::array<std::uint64_t, 5>;

std::array<std::uint64_t, 3> rows_of(const FaceRecord& face) {
  return {face[0], face[1], face[2] >> 1};
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

ShapeSink::ShapeSink(const std::filesystem::path& folder)
    : folder_(folder), positions_(folder), faces_(folder, kSortBytes) {}

void ShapeSink::write_vertices(std::span<const Position> positions) {
  for (const Position& p : positions) positions_.append(p);
}

void ShapeSink::write_tets(std::span<const io::TetRows> tets, std::span<const RawLabel> labels) {
  for (std::size_t t = 0; t < tets.size(); ++t) add_tet(tets[t], labels[t]);
}

void ShapeSink::add_tet(const io::TetRows& tet, RawLabel label) {
  io::TetRows rows = tet;
  std::sort(rows.begin(), rows.end());
  if (rows[3] >= positions_.size()) {
    throw Error(ErrorKind::kInput, "a tet names vertex " + std::to_string(rows[3]) + " of " +
                                       std::to_string(positions_.size()));
  }
  const auto [a, b, c, d] = rows;
  const double volume6 = mw::volume6(positions_[a], positions_[b], positions_[c], positions_[d]);
  // The normal of a b c points at d, into the tet, when that is positive; with each swap it turns.
  const std::uint64_t positive = volume6 > 0 ? 1 : 0;
  const std::uint64_t negative = 1 - positive;
  faces_.add({a, b, c << 1 | negative, label});
  faces_.add({a, b, d << 1 | positive, label});
  faces_.add({a, c, d << 1 | negative, label});
  faces_.add({b, c, d << 1 | positive, label});
}

audit::ShapeReport ShapeSink::shape() {
  audit::ShapeMeter meter;
  io::ExternalSort<5> edges(folder_, kSortBytes);
  each_pair(faces_, rows_of, [&](const FaceRecord& one, const FaceRecord& other) {
    if (one[3] == other[3]) return;
    const auto [a, b, c] = rows_of(one);
    meter.add_triangle(positions_[a], positions_[b], positions_[c]);
    add_edges(one, other, edges);
  });
  const auto edge_of = [](const EdgeRecord& e) { return std::array{e[0], e[1]}; };
  each_pair(edges, edge_of, [&](const EdgeRecord& one, const EdgeRecord& other) {
    if (one[3] != other[3] || one[4] != other[4]) return;
    meter.add_edge(positions_[one[0]], positions_[one[1]],
                   {positions_[one[2] >> 1], (one[2] & 1) != 0},
                   {positions_[other[2] >> 1], (other[2] & 1) != 0});
  });
  return meter.report();
}

}  // namespace mw::cli
