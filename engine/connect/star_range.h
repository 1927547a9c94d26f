// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Stars of vertices whose rows follow one another, looked at without the others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/connect/connect_options.h"
#include "engine/connect/star.h"
#include "engine/connect/tet_chunk.h"

namespace mw::engine {

/// A vertex, the three others of a tet, the place of the tet (place_of()), and its label.
using StarRecord = std::array<std::uint64_t, 6>;

/// What stars are looked at by; everything outlives the rules.
struct StarRules {
  const SplitRule& split;
  const std::vector<LabelPair>& watched;  ///< ConnectOptions::watched
};

/// All tets that have a vertex of a range.
struct StarRange {
  /// What one takes while it is looked at, in a mesh whose vertices have some 24 tets each and
  /// whose rows are near each other where vertices are.
  static constexpr std::size_t kBytes = std::size_t{1} << 21U;

  std::uint64_t first_row = 0;
  std::vector<io::TetRows> tets;
  std::vector<RawLabel> labels;
  std::vector<std::uint32_t> pieces;  ///< by tet: its piece, of those of the whole mesh
  std::vector<std::uint64_t> places;  ///< by tet: see place_of()
};

/// Two pieces of the mesh that have a face in common.
struct PieceJoint {
  std::uint32_t one = 0;
  std::uint32_t other = 0;
  bool is_cut = false;  ///< whether the mesh comes apart at the face

  friend auto operator<=>(const PieceJoint&, const PieceJoint&) = default;
};

struct StarFindings {
  std::vector<PieceJoint> joints;    ///< ascending, each once
  std::vector<RawLabel> insides;     ///< labels of vertices inside one, ascending, each once
  std::vector<StarRecord> pinched;   ///< stars that are no ball or half ball
  std::vector<std::size_t> watched;  ///< pairs of labels that were met, by number, ascending
};

/// Looks at the stars of the vertices of a range.  Cost: linear.
[[nodiscard]] StarFindings look_at_stars(const StarRange& range, const StarRules& rules);

/// Calls visit on each star of whole ones whose records are sorted.
void each_star(std::span<const StarRecord> records,
               const std::function<void(std::uint64_t row, std::vector<StarTet>& star)>& visit);

/// True if two tets of a star come apart.
[[nodiscard]] inline bool are_cut(const SplitRule& split, std::span<const StarTet> star,
                                  const StarPair& pair) {
  return split.any() && split.cuts(star[pair[0]].label, star[pair[1]].label);
}

/// Returns the piece of the tet at a place (place_of()).
[[nodiscard]] inline std::uint32_t piece_at(const std::vector<std::uint32_t>& first_pieces,
                                            std::uint64_t place) {
  return first_pieces[place >> 32] + static_cast<std::uint32_t>(place >> 16 & 0xffffU);
}

}  // namespace mw::engine
