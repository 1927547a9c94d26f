// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/output/claims.h"

#include <algorithm>
#include <tuple>

namespace mw::engine {

void Claims::add(Index3 block, std::span<const BlockVertex> vertices) {
  make_room(vertices.size());
  const std::uint64_t number = raster(block, share_.blocks());
  for (const BlockVertex& v : vertices) {
    const Index3 home = homes_.home(v.position);
    if (share_.is_own(homes_.line(home))) continue;
    list_.push_back({raster(home, share_.blocks()), v.id, number});
  }
}

/// A full list becomes twice as long as what is left of it, so each claim is sorted a few times.
void Claims::make_room(std::size_t more) {
  if (list_.size() + more <= list_.capacity()) return;
  compact();
  const std::size_t wanted = 2 * list_.size() + more;
  if (wanted <= list_.capacity()) return;
  if (hold_) hold_((list_.capacity() + wanted) * sizeof(Claim));
  list_.reserve(wanted);
}

void Claims::compact() {
  std::sort(list_.begin(), list_.end(), [](const Claim& a, const Claim& b) {
    return std::tie(a.home, a.id, a.first) < std::tie(b.home, b.id, b.first);
  });
  const auto end = std::unique(list_.begin(), list_.end(), [](const Claim& a, const Claim& b) {
    return a.home == b.home && a.id == b.id;
  });
  list_.erase(end, list_.end());
}

std::vector<std::vector<Claim>> Claims::take(std::size_t ranks) {
  compact();
  if (hold_) hold_((list_.capacity() + list_.size()) * sizeof(Claim));
  const auto owner = [&](const Claim& c) { return share_.owner(share_.line_of(c.home)); };
  std::vector<std::size_t> counts(ranks);
  for (const Claim& c : list_) ++counts[owner(c)];
  std::vector<std::vector<Claim>> out(ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank) out[rank].reserve(counts[rank]);
  for (const Claim& c : list_) out[owner(c)].push_back(c);
  list_ = {};
  return out;
}

}  // namespace mw::engine
