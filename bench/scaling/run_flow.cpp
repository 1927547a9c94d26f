// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/run_flow.h"

#include <utility>

#include "engine/store/run_layout.h"

namespace mw::bench {

RunFlow::RunFlow(engine::RunLayout layout) : layout_(std::move(layout)) {
  for (std::uint32_t march = 0; march < layout_.marches(); ++march) {
    first_.push_back(first_.back() + static_cast<std::uint32_t>(layout_.order(march).size()));
    blocks_.push_back(static_cast<std::uint32_t>(layout_.grid(march).blocks_of({0, 0, 0}).size()));
  }
  inputs_.resize(windows());
  seen_.resize(windows());
  for (std::uint32_t march = 0; march < layout_.marches(); ++march) add_march(march);
}

void RunFlow::add_march(std::uint32_t march) {
  const engine::BlockRoute route(layout_);
  std::vector<engine::WindowOrder> orders;
  for (std::uint32_t m = 0; m < layout_.marches(); ++m) orders.push_back(layout_.order(m));
  std::vector<std::uint32_t>& next = next_.emplace_back();
  next.reserve(orders[march].size() * blocks_[march]);
  for (std::uint64_t rank = 0; rank < orders[march].size(); ++rank) {
    const engine::WindowKey from{march, orders[march].window(rank)};
    for (Index3 block : layout_.grid(march).blocks_of(from.window)) {
      const auto user = route.next_user({{march, block}, from});
      next.push_back(user ? first_[user->march] +
                                static_cast<std::uint32_t>(orders[user->march].rank(user->window))
                          : kOutput);
      if (!user) continue;
      ++inputs_[next.back()];
      if (user->march == march) ++seen_[next.back()];
    }
  }
}

std::uint32_t RunFlow::march_of(std::uint32_t window) const {
  std::uint32_t march = 0;
  while (window >= first_[march + 1]) ++march;
  return march;
}

engine::WindowKey RunFlow::key(std::uint32_t window) const {
  const std::uint32_t march = march_of(window);
  return {march, layout_.order(march).window(window - first_[march])};
}

std::span<const std::uint32_t> RunFlow::next_users(std::uint32_t window) const {
  const std::uint32_t march = march_of(window), count = blocks_[march];
  return std::span(next_[march]).subspan(std::size_t{window - first_[march]} * count, count);
}

int RunFlow::fresh_eighths(std::uint32_t window) const {
  const std::uint32_t blocks = blocks_[march_of(window)];
  return static_cast<int>(8 * (blocks - seen_[window]) / blocks);
}

}  // namespace mw::bench
