// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lists that ranks send to one another or add up, in messages that stay small.
#pragma once

#include <algorithm>
#include <functional>

#include "engine/team/team.h"

namespace mw::engine {

/// How swap_lists() sends its lists.
struct SwapOptions {
  /// The largest size of a message; REQUIRES: it is the same on all ranks.
  std::size_t max_bytes = std::size_t{1} << 22U;
  /// Optional; called with how many elements will come, before they do, and may throw.
  std::function<void(std::uint64_t count)> expect;
};

/// Returns the list that each rank has for this one, by rank; `mine` has this rank's list for each.
/// Memory: beside the lists two messages from and to each rank.  ERRORS: those of Team::gather().
template <typename T>
[[nodiscard]] std::vector<std::vector<T>> swap_lists(Team& team,
                                                     const std::vector<std::vector<T>>& mine,
                                                     const SwapOptions& options = {}) {
  const auto ranks = static_cast<std::size_t>(team.ranks());
  const std::size_t part = std::max<std::size_t>(options.max_bytes / sizeof(T), 1);
  std::vector<std::vector<std::byte>> messages(ranks);
  std::uint64_t longest = 0;
  for (std::size_t to = 0; to < ranks; ++to) {
    const std::uint64_t size = mine[to].size();
    longest = std::max(longest, size);
    messages[to] = bytes_of(&size, 1);
  }
  std::uint64_t coming = 0;
  std::vector<std::vector<T>> out(ranks);
  const auto sizes = team.trade(std::move(messages));
  for (const auto& size : sizes) coming += list_of<std::uint64_t>(size).at(0);
  if (options.expect) options.expect(coming);
  for (std::size_t from = 0; from < ranks; ++from) {
    out[from].reserve(list_of<std::uint64_t>(sizes[from]).at(0));
  }
  for (const auto& said : team.gather(bytes_of(&longest, 1))) {
    longest = std::max(longest, list_of<std::uint64_t>(said).at(0));
  }
  for (std::size_t begin = 0; begin < longest; begin += part) {
    messages.assign(ranks, {});
    for (std::size_t to = 0; to < ranks; ++to) {
      if (begin >= mine[to].size()) continue;
      messages[to] = bytes_of(mine[to].data() + begin, std::min(part, mine[to].size() - begin));
    }
    const auto came = team.trade(std::move(messages));
    for (std::size_t from = 0; from < ranks; ++from) {
      const std::vector<T> list = list_of<T>(came[from]);
      out[from].insert(out[from].end(), list.begin(), list.end());
    }
  }
  return out;
}

}  // namespace mw::engine
