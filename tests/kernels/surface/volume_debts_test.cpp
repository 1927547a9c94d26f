// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Debts of vertices against a map.
#include "kernels/surface/volume_debts.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <tuple>

#include "tests/oracle/small_volumes.h"

namespace mw::test {
namespace {

using audit::test::below;

/// A visit replaces all that the vertex owed, pairs that are gone included.
TEST(VolumeDebts, AreThoseOfTheLastVisit) {
  std::mt19937 random(1111);
  VolumeDebts debts;
  std::map<std::tuple<LocalVertex, Label, Label>, double> expected;
  for (int i = 0; i < 300; ++i) {
    const LocalVertex visited = below(random, 5);
    std::vector<VolumeDebt> owed;
    for (Label low = 0; low < 3; ++low) {
      for (Label high = low + 1; high < 4; ++high) {
        expected.erase({visited, low, high});
        if (below(random, 2) == 0) continue;
        owed.push_back({low, high, 1.0 + i});
        expected[{visited, low, high}] = 1.0 + i;
      }
    }
    debts.set(visited, owed);
    for (LocalVertex v = 0; v < 6; ++v) {
      for (Label low = 0; low < 3; ++low) {
        for (Label high = low + 1; high < 4; ++high) {
          const auto found = expected.find({v, low, high});
          ASSERT_EQ(debts.of(v, low, high), found == expected.end() ? 0.0 : found->second);
        }
      }
    }
  }
}

}  // namespace
}  // namespace mw::test
