// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Traces read back: durations by window, and refusal of what is not a whole trace.
#include "bench/scaling/trace_table.h"

#include <gtest/gtest.h>

#include <sstream>

#include "kernels/core/error.h"

namespace mw::bench {
namespace {

constexpr const char* kNames = "march,x,y,z,start_s,end_s,cpu_s,slot\n";

std::vector<MarchTrace> read(const std::string& lines, Clock clock) {
  std::istringstream in(kNames + lines);
  return read_trace(in, clock);
}

TEST(TraceTable, GivesDurationsByWindow) {
  const std::string lines =
      "0,1,0,0,2.5,3.5,0.75,1\n"
      "0,0,0,0,1,1.5,0.25,0\n"
      "1,0,0,0,4,6,1.5,0\n";
  const auto wall = read(lines, Clock::kWall);
  ASSERT_EQ(wall.size(), 2U);
  EXPECT_EQ(wall[0].windows, (Index3{2, 1, 1}));
  EXPECT_EQ(wall[0].seconds, (std::vector<double>{0.5, 1.0}));
  EXPECT_EQ(wall[1].windows, (Index3{1, 1, 1}));
  EXPECT_EQ(wall[1].seconds, (std::vector<double>{2.0}));
  EXPECT_EQ(read(lines, Clock::kCpu)[0].seconds, (std::vector<double>{0.25, 0.75}));
}

TEST(TraceTable, RefusesWhatIsNotAWholeTrace) {
  EXPECT_THROW(read("0,1,0,0,2.5,3.5,0.75\n", Clock::kCpu), Error);
  EXPECT_THROW(read("0,1,zero,0,2.5,3.5,0.75,0\n", Clock::kCpu), Error);
  EXPECT_THROW(read("0,1,0,0,2.5,3.5,0.75,0\n", Clock::kCpu), Error) << "window 0,0,0 is missing";
}

}  // namespace
}  // namespace mw::bench
