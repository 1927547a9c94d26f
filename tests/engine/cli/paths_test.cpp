// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The work folder and the files of a run are apart, or the run says so before any work.
#include "engine/cli/mesh/progress.h"
#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

using engine::RunProgress;

class PathsTest : public ProgramTest {};

/// The input is damaged behind its header: who began to read would say so.
TEST_F(PathsTest, WorkFoldersThatCollideAreRefusedBeforeWork) {
  make_volume();
  write("v.npy", read("v.npy").substr(0, 300));
  write("names.csv", "id,name\n1,one\n");
  const std::string mesh = "mesh v.npy -o m.vtu ";
  expect_failure(2, mesh + "--workdir m.vtu", "--workdir m.vtu: this is the output");
  expect_failure(2, mesh + "--workdir ./x/../m.vtu", "this is the output");
  expect_failure(2, mesh + "--workdir m.vtu/", "this is the output");
  expect_failure(2, mesh + "--workdir m.vtu/work", "lies in m.vtu, the output");
  expect_failure(2, mesh + "--workdir .", "has v.npy in it, the input");
  expect_failure(2, "mesh v.npy -o w/m.vtu --workdir w", "has w/m.vtu in it, the output");
  expect_failure(2, mesh + "--workdir v.npy", "this is the input");
  expect_failure(2, mesh + "--report r.json --workdir r.json", "this is --report");
  expect_failure(2, mesh + "--html r.html --workdir r.html", "this is --html");
  expect_failure(2, mesh + "--trace t.csv --workdir t.csv", "this is --trace");
  expect_failure(2, mesh + "--names names.csv --workdir names.csv", "this is --names");
  expect_failure(2, mesh + "--report m.vtu.work", "this is --report");
  expect_failure(2, "mesh v.npy -o m.xdmf --workdir m.h5", "this is the output");
  expect_failure(3, mesh + "--workdir m.vtu2", "v.npy");
}

/// No output takes the place of what the command reads or of another output.
TEST_F(PathsTest, NamesAreUsedOnce) {
  make_volume();
  write("names.csv", "id,name\n1,one\n");
  write("run.toml", "window = 8\n");
  expect_done("mesh v.npy -o m.msh");
  expect_done("convert m.msh m.vtu");
  expect_done("convert m.vtu p.pvtu --pieces 2");
  std::filesystem::create_hard_link(folder() / "m.vtu", folder() / "same.vtu");
  const std::string before = read("v.npy") + read("m.vtu") + read("names.csv") + read("run.toml");
  const std::string twice = ": name used twice, this is ";
  for (const auto& [words, piece] : std::initializer_list<std::array<std::string, 2>>{
           {"verify v.npy m.vtu --report v.npy", "--report v.npy" + twice + "the input"},
           {"verify v.npy m.vtu --report ./m.vtu", "--report ./m.vtu" + twice + "the mesh to read"},
           {"verify v.npy m.vtu --report same.vtu", twice + "the mesh to read"},
           {"verify v.npy m.vtu --names names.csv --report names.csv", twice + "--names"},
           {"verify v.npy m.msh --report m.msh.labels.csv", twice + "the mesh to read"},
           {"verify v.npy p.pvtu --report p/p_0000.vtu", twice + "the mesh to read"},
           {"verify v.npy,v.npy m.vtu --report v.npy", twice + "the input"},
           {"mesh v.npy -o a.xdmf --report a.h5", "--report a.h5" + twice + "-o"},
           {"mesh v.npy -o d.msh --html d.msh.labels.csv", "--html d.msh.labels.csv" + twice},
           {"mesh v.npy -o a.inp --sample x=v.npy --materials x=2 --trace a.inp.materials.csv",
            "--trace a.inp.materials.csv" + twice + "-o"},
           {"mesh v.npy -o a.vtu --size @v2.npy --report v2.npy", twice + "--size"},
           {"mesh v.npy -o a.vtu --config run.toml --report run.toml", twice + "--config"},
           {"convert m.vtu d.msh --pairs d.msh.labels.csv", "--pairs d.msh.labels.csv" + twice},
           {"convert m.vtu m.vtu", "-o m.vtu" + twice + "the mesh to read"},
           {"convert m.msh m.msh2 --pairs m.msh.labels.csv", twice + "the mesh to read"}}) {
    expect_failure(2, words, piece);
  }
  std::filesystem::create_symlink("m.vtu", folder() / "m.png");
  expect_failure(2, "picture m.vtu -o m.png", "-o m.png" + twice + "the mesh to read");
  std::filesystem::create_symlink("m.vtu", folder() / "m.stl");
  expect_failure(2, "surface m.vtu -o m.stl", "-o m.stl" + twice + "the mesh to read");
  EXPECT_EQ(read("v.npy") + read("m.vtu") + read("names.csv") + read("run.toml"), before);
}

TEST_F(PathsTest, LinksAreFollowed) {
  make_volume();
  std::filesystem::create_directory(folder() / "real");
  std::filesystem::create_symlink("real", folder() / "link");
  expect_failure(2, "mesh v.npy -o real/m.vtu --workdir link", "has real/m.vtu in it");
  expect_failure(2, "mesh v.npy -o link/m.vtu --workdir real/m.vtu", "this is the output");
  expect_done("mesh v.npy -o link/m.vtu --workdir real/work");
}

// Systems that give fewer threads than were asked for, or none.

/// The program on a system that gives this number of threads beside the first.
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

// What a user sees of a run on a terminal, and what is not shown.

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
