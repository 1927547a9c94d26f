// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Mistyped flags, subcommands, config keys and variables: refused, with what was meant.
#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

class MistypedTest : public ProgramTest {};

TEST_F(MistypedTest, FlagsAndSubcommands) {
  expect_failure(2, "mash", "mash: unknown subcommand; did you mean mesh?");
  expect_failure(2, "convrt a.vtu b.mesh", "did you mean convert?");
  expect_failure(2, "mesh v.npy -o v.vtu --windwo 16",
                 "--windwo: unknown flag; did you mean --window?");
  expect_failure(2, "mesh v.npy -o v.vtu --windwo=16",
                 "--windwo: unknown flag; did you mean --window?");
  expect_failure(2, "mesh v.npy -o v.vtu --max_distance 2", "did you mean --max-distance?");
  expect_failure(2, "verify v.npy v.vtu --max-dist 2", "did you mean --max-distance?");
  expect_failure(2, "info v.npy --jsn", "did you mean --json?");
}

/// Though a flag that must be there is missing then.
TEST_F(MistypedTest, FlagsThatMustBeThere) {
  expect_failure(2, "synth voronoi --shap 3,3,3 --labels 2 --seed 1 -o w.npy",
                 "did you mean --shape?");
}

TEST_F(MistypedTest, NothingIsSuggestedWhereNothingIsNear) {
  for (const std::string words : {"mesh v.npy -o v.vtu --foo", "xylophone", "mesh a.npy b.npy"}) {
    const ProgramRun refused = run(words);
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(refused.err.find("did you mean"), std::string::npos) << refused.err;
  }
}

TEST_F(MistypedTest, ConfigKeys) {
  write("c.toml", "window = 32\nedge-variance = 0.1\n");
  expect_failure(2, "mesh --print-config --config c.toml",
                 "c.toml:2: edge-variance: unknown key; did you mean edge_variance?");
}

TEST_F(MistypedTest, VariablesWhateverTheSubcommand) {
  make_volume();
  for (const std::string words : {"mesh --print-config", "info v.npy", "digest v.vtu",
                                  "synth voronoi --shape 3,3,3 --labels 2 --seed 1 -o w.npy"}) {
    expect_failure(2, words,
                   "MW_THREDS: no option has this environment variable; did you mean MW_THREADS?",
                   "MW_THREDS=2");
    expect_failure(2, words, "did you mean MW_QUALITY_FLOOR?", "MW_QUALITYFLOOR=2");
    expect_failure(2, words, "MW_FOO: no option", "MW_FOO=1");
    expect_failure(2, words, "MW_: no option", "MW_=1");
  }
}

TEST_F(MistypedTest, VariablesOfOtherSubcommandsAreFine) {
  make_volume();
  expect_done("info v.npy", "MW_THREADS=2");
  expect_done("mesh --print-config", "MW_MAX_VOLUME_ERROR=0.1");
  expect_done("info v.npy", "MW_CODT_WORKER=/nowhere");
  expect_done("info v.npy", "MW_PROGRAM=mwmesh MW_TEST_KILLS=3 MWFOO=1 MW_EMPTY=");
  expect_done("--version", "MW_FOO=1");
}

/// A flag that has no variable: setting one would change nothing.
TEST_F(MistypedTest, VariablesOfFlagsThatHaveNone) {
  make_volume();
  expect_failure(2, "info v.npy", "MW_JSON: no option", "MW_JSON=1");
  expect_failure(2, "mesh --print-config", "MW_SEED: no option", "MW_SEED=1");
}

TEST_F(MistypedTest, SizesAsPeopleWriteThem) {
  EXPECT_NE(run("mesh --print-config --memory 1.5g").out.find("memory = \"1.5g\"\n"),
            std::string::npos);
  make_volume();
  expect_done("mesh v.npy -o v.vtu --memory 1G --report r.json");
  EXPECT_NE(read("r.json").find("\"memory_budget_bytes\": 1073741824"), std::string::npos);
  expect_failure(2, "mesh v.npy -o w.vtu --memory 1X", "--memory 1X: expected a size such as 512M");
}

}  // namespace
}  // namespace mw::cli
