// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lists of all ranks, added up or whatever else makes one of two.
#pragma once

#include <algorithm>

#include "engine/team/plain_bytes.h"
#include "engine/team/team.h"

namespace mw::engine {

/// Replaces each element of rank 0's list by fold(fold(its own, rank 1's), rank 2's) and so on.
/// Memory: max_bytes a rank, on rank 0.  REQUIRES: all lists are of one size, all ranks have the
/// same max_bytes.  ERRORS: as Team::gather().
template <typename T, typename Fold>
void fold_lists(Team& team, std::vector<T>& mine, Fold fold,
                std::size_t max_bytes = std::size_t{1} << 22U) {
  const std::size_t part = std::max<std::size_t>(max_bytes / sizeof(T), 1);
  for (std::size_t begin = 0; begin < mine.size(); begin += part) {
    std::vector<std::vector<std::byte>> messages(static_cast<std::size_t>(team.ranks()));
    if (!team.is_first()) {
      messages[0] = bytes_of(mine.data() + begin, std::min(part, mine.size() - begin));
    }
    const auto came = team.trade(std::move(messages));
    for (std::size_t from = 1; team.is_first() && from < came.size(); ++from) {
      const std::vector<T> theirs = list_of<T>(came[from]);
      for (std::size_t i = 0; i < theirs.size(); ++i) {
        mine[begin + i] = fold(mine[begin + i], theirs[i]);
      }
    }
  }
}

}  // namespace mw::engine
