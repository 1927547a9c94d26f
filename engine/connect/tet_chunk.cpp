// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/connect/tet_chunk.h"

#include <algorithm>
#include <iterator>

#include "engine/connect/star.h"
#include "engine/connect/tet_faces.h"
#include "kernels/core/sort_distinct.h"

namespace mw::engine {
namespace {

std::vector<std::uint32_t> pieces_of(const TetChunk& chunk, const SplitRule& split) {
  const EarlierTets earlier = earlier_tets(local_tets(chunk.tets));
  StarSets sets(chunk.tets.size());
  for (std::size_t t = 0; t < earlier.size(); ++t) {
    for (const std::uint32_t other : earlier[t]) {
      if (other == kNoTet || split.cuts(chunk.labels[t], chunk.labels[other])) continue;
      sets.unite(t, other);
    }
  }
  const std::vector<std::size_t> numbers = sets.numbers();
  return {numbers.begin(), numbers.end()};
}

}  // namespace

void look_at_chunk(std::uint64_t first, const SplitRule& split, TetChunk& chunk) {
  chunk.pieces = pieces_of(chunk, split);
  chunk.ranges.reserve(2 * chunk.tets.size());
  for (std::size_t t = 0; t < chunk.tets.size(); ++t) {
    add_ranges(first + t, chunk.tets[t], chunk.ranges);
  }
  std::unique_copy(chunk.labels.begin(), chunk.labels.end(), std::back_inserter(chunk.labels_met));
  sort_distinct(chunk.labels_met);
}

}  // namespace mw::engine
