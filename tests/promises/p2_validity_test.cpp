// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 2: the mesh is a partition of the box into positive tets.
#include <gtest/gtest.h>

#include "tests/promises/whole_runs.h"

namespace mw::engine {
namespace {

using namespace test;

TEST(Promise2Validity, OneLabelBecomesFewTetsOfTheExactBox) {
  std::mt19937 random(107);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 1, 12);
    const SmallVolume volume = volume_from(shape, 1, [](auto, auto, auto) { return 0; });
    const std::size_t vertices = expect_promises(random_trial(random, volume), Counter::kAudit);
    EXPECT_GE(vertices, 8U);
  }
}

}  // namespace
}  // namespace mw::engine
