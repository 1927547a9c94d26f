// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/keep/required_visits.h"
#include "engine/store/run_layout.h"
#include "tests/engine/store/layouts.h"
#include "tests/oracle/small_volumes.h"

namespace mw::engine {
namespace {

using audit::test::below;
using namespace test;

using Windows = std::vector<bool>;

/// Says of each version which window takes it next.
template <typename Use>
void for_users(const RunLayout& layout, Use use) {
  const BlockRoute route(layout);
  for_windows(layout, [&](const WindowKey& from) {
    for (const Index3 block : layout.grid(from.march).blocks_of(from.window)) {
      const auto user = route.next_user({{from.march, block}, from});
      if (user) use(layout.window(from), layout.window(*user));
    }
  });
}

/// By going over all versions until nothing changes any more.
Windows slowly(const RunLayout& layout, const Windows& edited, const Windows& dropped) {
  Windows differs = edited, required(layout.windows());
  for (bool changed = true; changed;) {
    changed = false;
    for_users(layout, [&](std::uint64_t from, std::uint64_t user) {
      if (!differs[from] || differs[user]) return;
      differs[user] = changed = true;
    });
  }
  for (bool changed = true; changed;) {
    changed = false;
    for_users(layout, [&](std::uint64_t from, std::uint64_t user) {
      if (required[from] || !dropped[from] || !(differs[user] || required[user])) return;
      required[from] = changed = true;
    });
  }
  return required;
}

Windows random_windows(std::mt19937& random, const RunLayout& layout, std::uint32_t one_of) {
  Windows out(layout.windows());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = below(random, one_of) == 0;
  return out;
}

TEST(RequiredVisits, AreWhatEditedWindowsNeedAndIsGone) {
  std::mt19937 random(71);
  std::size_t required = 0, not_required = 0;
  for_layouts([&](const RunLayout& layout) {
    const Windows edited = random_windows(random, layout, 1 + below(random, 60));
    const Windows dropped = random_windows(random, layout, 1 + below(random, 3));
    const Windows found = required_visits(
        layout, [&](const WindowKey& key) { return !edited[layout.window(key)]; },
        [&](std::uint64_t window) { return dropped[window]; });
    EXPECT_EQ(found, slowly(layout, edited, dropped));
    for (std::size_t i = 0; i < found.size(); ++i) {
      required += static_cast<std::size_t>(found[i]);
      not_required += static_cast<std::size_t>(dropped[i] && !found[i]);
    }
  });
  EXPECT_GT(required, 100U);
  EXPECT_GT(not_required, 100U);
}

}  // namespace
}  // namespace mw::engine
