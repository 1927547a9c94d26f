// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/connect/tet_chunk.h"

#include <algorithm>

#include "engine/connect/star.h"
#include "kernels/core/sort_distinct.h"

namespace mw::engine {
namespace {

/// A face of a chunk's tet, and that tet.
using ChunkFace = std::array<std::uint64_t, 4>;

/// Returns the four faces of each tet, as ascending rows, in the order of the faces.
std::vector<ChunkFace> faces_of(const std::vector<io::TetRows>& sorted_tets) {
  std::vector<ChunkFace> out;
  out.reserve(4 * sorted_tets.size());
  for (std::size_t t = 0; t < sorted_tets.size(); ++t) {
    const auto [a, b, c, d] = sorted_tets[t];
    out.insert(out.end(), {{a, b, c, t}, {a, b, d, t}, {a, c, d, t}, {b, c, d, t}});
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::uint32_t> pieces_of(const TetChunk& chunk,
                                     const std::vector<io::TetRows>& sorted_tets,
                                     const SplitRule& split) {
  const std::vector<ChunkFace> faces = faces_of(sorted_tets);
  StarSets sets(chunk.tets.size());
  for (std::size_t f = 1; f < faces.size(); ++f) {
    const ChunkFace &one = faces[f - 1], &other = faces[f];
    if (!std::equal(one.begin(), one.begin() + 3, other.begin())) continue;
    if (!split.cuts(chunk.labels[one[3]], chunk.labels[other[3]])) sets.unite(one[3], other[3]);
  }
  const std::vector<std::size_t> numbers = sets.numbers();
  return {numbers.begin(), numbers.end()};
}

}  // namespace

void look_at_chunk(std::uint64_t number, const SplitRule& split, TetChunk& chunk) {
  std::vector<io::TetRows> sorted = chunk.tets;
  for (io::TetRows& rows : sorted) std::sort(rows.begin(), rows.end());
  chunk.pieces = pieces_of(chunk, sorted, split);
  chunk.corners.reserve(4 * sorted.size());
  for (std::size_t t = 0; t < sorted.size(); ++t) {
    const auto [a, b, c, d] = sorted[t];
    const std::uint64_t place = place_of(number, chunk.pieces[t], t);
    const RawLabel label = chunk.labels[t];
    chunk.corners.push_back({a, b, c, d, place, label});
    chunk.corners.push_back({b, a, c, d, place, label});
    chunk.corners.push_back({c, a, b, d, place, label});
    chunk.corners.push_back({d, a, b, c, place, label});
  }
  chunk.labels_met = chunk.labels;
  sort_distinct(chunk.labels_met);
}

}  // namespace mw::engine
