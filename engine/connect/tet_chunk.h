// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets that follow one another in a mesh, looked at without the others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/connect/connect_options.h"
#include "engine/connect/row_ranges.h"
#include "io/mesh/mesh_sink.h"

namespace mw::engine {

struct TetChunk {
  static constexpr std::size_t kTets = 1024;
  /// The most memory that one takes, while it is made, too.
  static constexpr std::size_t kBytes = std::size_t{3} << 16U;

  std::vector<io::TetRows> tets;
  std::vector<RawLabel> labels;
  /// By tet; tets that are joined by faces which do not come apart are a piece.  Pieces are
  /// numbered by their first tets.
  std::vector<std::uint32_t> pieces;
  std::vector<RangeTet> ranges;      ///< those of each tet
  std::vector<RawLabel> labels_met;  ///< those of all tets, ascending, each once
};

/// Returns the place of a tet: its chunk, then its piece and itself, both counted in the chunk.
[[nodiscard]] inline std::uint64_t place_of(std::uint64_t chunk, std::uint64_t piece,
                                            std::uint64_t tet) {
  return chunk << 32 | piece << 16 | tet;
}

/// Fills a chunk that has tets, whose first one has this number, and labels.
void look_at_chunk(std::uint64_t first, const SplitRule& split, TetChunk& chunk);

}  // namespace mw::engine
