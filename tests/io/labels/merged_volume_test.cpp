// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/labels/merged_volume.h"

#include "tests/testing.h"

namespace mw::io {
namespace {

TEST(MergedLabels, AreWhatRulesMakeOfLabelsAllAtOnce) {
  const std::vector<MergeRule> rules{{.from = {1, 2}, .to = 3}, {.from = {3}, .to = 9}};
  EXPECT_EQ(merged_labels({7, 2, 1}, rules), (std::vector<RawLabel>{3, 7}));
  EXPECT_EQ(merged_labels({3}, rules), (std::vector<RawLabel>{9}));
  EXPECT_EQ(merged_labels({5, 5}, {}), (std::vector<RawLabel>{5}));
}

}  // namespace
}  // namespace mw::io
