// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bits of comparisons, one by one and four at a time.
#include "kernels/core/lanes.h"

#include <gtest/gtest.h>

namespace mw::test {
namespace {

/// Numbers whose k-th is 1 where bit k is set, and 2 elsewhere.
LaneInts ones_at(unsigned bits) {
  const auto at = [bits](unsigned k) { return (bits >> k & 1U) != 0 ? 1 : 2; };
  return LaneInts{at(0), at(1), at(2), at(3)};
}

TEST(Lanes, BitsTellWhereAComparisonHolds) {
  for (unsigned bits = 0; bits < 16; ++bits) EXPECT_EQ(lane_bits(ones_at(bits) == 1), bits);
}

TEST(Lanes, BitsOfFourComparisonsStandSideBySide) {
  for (unsigned bits = 0; bits < 1U << 16; ++bits) {
    const LaneInts a = ones_at(bits & 15U), b = ones_at(bits >> 4 & 15U),
                   c = ones_at(bits >> 8 & 15U), d = ones_at(bits >> 12);
    ASSERT_EQ(lane_bits(a == 1, b == 1, c == 1, d == 1), bits);
  }
}

}  // namespace
}  // namespace mw::test
