// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Stars of vertices that follow one another, looked at without the others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/connect/connect_options.h"
#include "engine/connect/star.h"
#include "engine/connect/tet_chunk.h"

namespace mw::engine {

/// What stars are looked at by; everything outlives the rules.
struct StarRules {
  const SplitRule& split;
  const std::vector<LabelPair>& watched;             ///< ConnectOptions::watched
  const std::vector<std::uint32_t>& first_pieces{};  ///< the first piece of each chunk
};

/// Two pieces of the mesh that have a face in common.
struct PieceJoint {
  std::uint32_t one = 0;
  std::uint32_t other = 0;
  bool is_cut = false;  ///< whether the mesh comes apart at the face
};

struct StarFindings {
  /// The most memory that those of kStarRecords take, with the records.
  static constexpr std::size_t kBytes = std::size_t{3} << 17U;

  std::vector<PieceJoint> joints;
  std::vector<RawLabel> insides;     ///< labels of vertices inside one, ascending, each once
  std::vector<StarRecord> pinched;   ///< stars that are no ball or half ball
  std::vector<std::size_t> watched;  ///< pairs of labels that were met, by number
};

/// How many corners are looked at at once, or as many as one star has.
inline constexpr std::size_t kStarRecords = 2048;

/// REQUIRES: whole stars, whose records are sorted.
[[nodiscard]] StarFindings look_at_stars(std::span<const StarRecord> records,
                                         const StarRules& rules);

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
