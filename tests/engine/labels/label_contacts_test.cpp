// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Contacts of labels against a plain loop over the array.
#include "engine/labels/label_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "kernels/core/index.h"
#include "tests/engine/memory_run.h"

namespace mw::engine {
namespace {

TEST(LabelContacts, AreThoseOfAPlainLoop) {
  std::mt19937 random(3);
  for (std::int64_t seed = 0; seed < 12; ++seed) {
    // The last one has several tiles along y and z.
    test::SmallVolume small{seed == 11 ? Index3{700, 30, 40} : Index3{7 + seed % 3, 5, 1 + seed}};
    small.labels.resize(static_cast<std::size_t>(small.shape.product()));
    for (Label& label : small.labels) label = static_cast<Label>(random() % 5);
    const test::MemoryVolume volume(small, {});
    const Box3 all{{0, 0, 0}, small.shape};
    std::map<std::pair<RawLabel, RawLabel>, std::array<std::uint64_t, 3>> expected;
    const std::array<Index3, 3> steps{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const auto at = [&](Index3 v) {
      return test::raw_label(small.labels[static_cast<std::size_t>(all.offset(v))]);
    };
    for_each_index(small.shape, [&](Index3 v) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (!all.contains(v + steps[k])) continue;
        const std::pair<RawLabel, RawLabel> pair = std::minmax({at(v), at(v + steps[k])});
        if (pair.first != pair.second) ++expected[pair][k];
      }
    });
    auto next = expected.begin();
    for (const LabelContact& contact : label_contacts(volume)) {
      ASSERT_NE(next, expected.end());
      EXPECT_EQ(std::pair(contact.first, contact.second), next->first);
      EXPECT_EQ(contact.faces, next->second);
      ++next;
    }
    EXPECT_EQ(next, expected.end());
  }
}

}  // namespace
}  // namespace mw::engine
