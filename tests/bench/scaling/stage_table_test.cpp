// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Stages of a report: what cores share, and what one of them does alone.
#include "bench/scaling/stage_table.h"

#include "kernels/core/error.h"
#include "tests/testing.h"

namespace mw::bench {
namespace {

constexpr const char* kReport = R"({"performance": {"cpu_s": 20, "costs": [
    {"name": "prepare", "cpu_s": 4, "alone_s": 1},
    {"name": "march", "cpu_s": 10, "alone_s": 0.5},
    {"name": "file", "cpu_s": 3, "alone_s": 3}]}})";

TEST(StageTable, CoresShareWhatIsNotAlone) {
  const auto stages = read_stages(kReport, "r.json");
  ASSERT_EQ(stages.size(), 4U);
  EXPECT_EQ(stages[0].name, "prepare");
  EXPECT_EQ(stages[3].name, "rest");
  EXPECT_EQ(stages[3].cpu_seconds, 3.0);
  EXPECT_EQ(shared_by(stages[0], 1), 4.0);
  EXPECT_EQ(shared_by(stages[0], 3), 2.0);
  // 2 of prepare, .5 of the march, 3 of the file, 3 of the rest.
  EXPECT_EQ(seconds_beside_visits(stages, 3), 8.5);
}

TEST(StageTable, HoldsWhatMemoryCannotSpill) {
  EXPECT_EQ(read_held_bytes(R"({"engine": {"peak_bytes_by_purpose": {"program": 1, "labels": 20,
      "index": 300, "blocks": 4000, "windows": 50000, "output": 600000}}})",
                            "r.json"),
            301U);
  EXPECT_THROW((void)read_held_bytes(kReport, "r.json"), Error);
}

TEST(StageTable, MemoryFeedsAsManyCoresAsItsBandwidthAllows) {
  // A core moves 40 bytes in 20 seconds, 2 a second.
  EXPECT_EQ(fed_cores(64, 40.0, 20.0, 11.0), 5U);
  EXPECT_EQ(fed_cores(4, 40.0, 20.0, 11.0), 4U);
  EXPECT_EQ(fed_cores(4, 40.0, 20.0, 1.0), 1U) << "one core waits for memory as it was measured";
}

TEST(StageTable, RefusesWhatIsNotTheReportOfOneThread) {
  EXPECT_THROW((void)read_stages("{", "r.json"), Error);
  EXPECT_THROW((void)read_stages("{}", "r.json"), Error);
  EXPECT_THROW((void)read_stages(R"({"performance": {"cpu_s": 1, "costs": [
      {"name": "file", "cpu_s": 3, "alone_s": null}]}})",
                                 "r.json"),
               Error);
}

}  // namespace
}  // namespace mw::bench
