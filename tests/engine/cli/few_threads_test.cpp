// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Systems that give fewer threads than were asked for, or none.
#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

/// Starts the program on a system that gives `allowed` threads beside the first.
std::string with_threads(int allowed) {
  // An address sanitizer wants to be loaded first, and is after a preloaded library.
  return "ASAN_OPTIONS=verify_asan_link_order=0 ALLOWED_THREADS=" + std::to_string(allowed) +
         " LD_PRELOAD='" MW_FEW_THREADS "'";
}

class FewThreads : public ProgramTest {};

TEST_F(FewThreads, AreAWarningAndTheSameMesh) {
  make_volume();
  for (const std::string start : {"coarse", "octree"}) {
    const std::string mesh = "mesh v.npy --window 8 --start " + start;
    expect_done(mesh + " --threads 1 -o one.vtu");
    for (const int allowed : {0, 1, 3}) {
      const ProgramRun run = this->run(mesh + " --threads 4 -o few.vtu", with_threads(allowed));
      EXPECT_EQ(run.code, 0) << allowed << "\n" << run.err;
      const std::string warning =
          "the system gives " + std::to_string(allowed + 1) + " of 4 threads";
      EXPECT_EQ(run.err.find(warning) != std::string::npos, allowed < 3) << run.err;
      EXPECT_EQ(run.err.find("ulimit -u") != std::string::npos, allowed < 3) << run.err;
      EXPECT_TRUE(read("few.vtu") == read("one.vtu")) << allowed;
    }
  }
}

TEST_F(FewThreads, AreEnoughForEveryOtherCommand) {
  make_volume();
  expect_done("mesh v.npy -o m.vtkhdf");
  expect_done("verify v.npy m.vtkhdf", with_threads(0));
  expect_done("info m.vtkhdf v.npy --betti", with_threads(0));
  expect_done("convert m.vtkhdf m.vtu", with_threads(0));
  expect_done("digest m.vtkhdf", with_threads(0));
  expect_done("info m.vtkhdf", with_threads(0));
  expect_done("surface m.vtkhdf -o s.stl", with_threads(0));
  expect_done("picture m.vtkhdf -o p.png", with_threads(0));
  expect_done("synth tubes --shape 20,20,20 --labels 3 --seed 1 -o t.npy", with_threads(0));
}

}  // namespace
}  // namespace mw::cli
