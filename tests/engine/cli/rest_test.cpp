// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The mesh is complete and what goes beside it is not: the rest is written by --resume, without
// meshing again.  (tests/faults/io_errors.py has each call fail.)
#include <nlohmann/json.hpp>

#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

using nlohmann::json;

class RestTest : public ProgramTest {};

/// The name of the page is taken while the run goes on.
TEST_F(RestTest, IsWrittenByResume) {
  expect_done("synth noise --labels 3 --seed 1 -o v.npy --shape 20,20,20");
  expect_done("mesh v.npy -o whole.vtkhdf --window 8");
  const std::string mesh = "mesh v.npy -o v.vtkhdf --window 8 --report r.json --html p.html ";
  const ProgramRun stopped = run(mesh, "sh -c '(sleep 0.7; mkdir p.html) & exec \"$0\" \"$@\"'");
  ASSERT_EQ(stopped.code, 2) << stopped.err;
  EXPECT_NE(stopped.err.find("v.vtkhdf, r.json are complete; add --resume"), std::string::npos)
      << stopped.err;
  EXPECT_EQ(read("v.vtkhdf"), read("whole.vtkhdf"));
  EXPECT_TRUE(files().contains("v.vtkhdf.work"));
  const std::uint64_t windows = json::parse(read("r.json"))["engine"]["windows"];
  EXPECT_GT(windows, 0U);
  std::filesystem::remove(folder() / "p.html");
  expect_failure(2, mesh, "add --resume to go on");
  expect_done(mesh + "--resume");
  const json r = json::parse(read("r.json"));
  EXPECT_EQ(r["engine"]["windows"], 0) << "meshed again";
  EXPECT_EQ(r["engine"]["windows_resumed"], windows);
  EXPECT_EQ(read("v.vtkhdf"), read("whole.vtkhdf"));
  EXPECT_EQ(files(),
            (std::set<std::string>{"v.npy", "whole.vtkhdf", "v.vtkhdf", "r.json", "p.html"}));
}

TEST_F(RestTest, LeavesNoWorkBehind) {
  make_volume();
  expect_done("mesh v.npy -o v.vtu --report r.json --trace t.csv");
  EXPECT_EQ(files(), (std::set<std::string>{"v.npy", "v.vtu", "r.json", "t.csv"}));
}

}  // namespace
}  // namespace mw::cli
