// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a user sees of a run on a terminal, and what is not shown.
#include "engine/cli/mesh/progress.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mw::cli {
namespace {

using engine::RunProgress;

/// What a run that is at these places in turn leaves on stderr, its end included.
std::string shown(ProgressKind kind, const std::vector<RunProgress>& positions) {
  testing::internal::CaptureStderr();
  {
    Progress progress(kind);
    for (const RunProgress& at : positions) progress.show(at);
  }
  return testing::internal::GetCapturedStderr();
}

std::string bar(std::size_t full) {
  return "\r\033[K[" + std::string(full, '#') + std::string(30 - full, '.') + "] ";
}

TEST(ProgressBar, GrowsInItsLineWhichEndsWithTheRun) {
  EXPECT_EQ(shown(ProgressKind::kBar, {{.done = 1, .total = 4}, {.done = 4, .total = 4}}),
            bar(7) + "1/4 windows" + bar(30) + "4/4 windows\n");
}

TEST(ProgressBar, TellsTheTimeLeftRoughly) {
  const auto left = [](double seconds) {
    return shown(ProgressKind::kBar, {{.done = 1, .total = 30, .seconds_left = seconds}});
  };
  EXPECT_EQ(left(0.2), bar(1) + "1/30 windows, about 0 s left\n");
  EXPECT_EQ(left(47.4), bar(1) + "1/30 windows, about 47 s left\n");
  EXPECT_EQ(left(720), bar(1) + "1/30 windows, about 12 min left\n");
  EXPECT_EQ(left(3.4 * 3600), bar(1) + "1/30 windows, about 3.4 h left\n");
}

// A terminal is slower than windows are.
TEST(ProgressBar, LeavesOutWhatComesAtOnce) {
  std::vector<RunProgress> positions;
  for (std::uint64_t done = 0; done <= 1000; ++done)
    positions.push_back({.done = done, .total = 1000});
  const std::string text = shown(ProgressKind::kBar, positions);
  EXPECT_NE(text.find(" 1/1000 "), std::string::npos) << text;
  EXPECT_EQ(text.find(" 2/1000 "), std::string::npos) << text;
  EXPECT_NE(text.find(" 1000/1000 "), std::string::npos) << text;
}

TEST(ProgressBar, IsNotThereWhereNothingIsToBeShown) {
  EXPECT_EQ(shown(ProgressKind::kNone, {{.done = 1, .total = 1}}), "");
  EXPECT_EQ(shown(ProgressKind::kBar, {}), "");
  testing::internal::CaptureStderr();  // which makes it a file
  const ProgressKind kind = parse_progress("auto");
  testing::internal::GetCapturedStderr();
  EXPECT_EQ(kind, ProgressKind::kNone);
}

}  // namespace
}  // namespace mw::cli
