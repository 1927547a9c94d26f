// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// --memory, --workdir and --resume as a user meets them.
#include <nlohmann/json.hpp>

#include "tests/engine/cli/run_program.h"
#include "tests/sanitizers.h"

namespace mw::cli {
namespace {

using nlohmann::json;

class ResumeProgramTest : public ProgramTest {
 protected:
  /// n.npy, whose mesh takes a few seconds.
  void make_noise(const std::string& shape = "30,30,30") const {
    expect_done("synth noise --labels 3 --seed 1 -o n.npy --shape " + shape);
  }

  /// A run that is interrupted after a while and leaves its work.
  void interrupt(const std::string& arguments, const std::string& workdir) const {
    const ProgramRun stopped = run("mesh n.npy -o n.vtu --window 8 " + arguments,
                                   "timeout --foreground --preserve-status -s TERM 0.6");
    EXPECT_EQ(stopped.code, 75) << stopped.err;
    EXPECT_NE(stopped.err.find("the work so far is in " + workdir), std::string::npos);
    EXPECT_TRUE(files().contains(workdir)) << stopped.err;
    EXPECT_FALSE(files().contains("n.vtu"));
  }
};

TEST_F(ResumeProgramTest, EndsWith75AndGoesOnToTheSameMesh) {
  make_noise();
  expect_done("mesh n.npy -o whole.vtu --window 8");
  interrupt("", "n.vtu.work");
  const std::string mesh = "mesh n.npy -o n.vtu ";
  expect_failure(2, mesh + "--window 8", "add --resume to go on");
  expect_failure(2, mesh + "--window 8 --force", "--force replaces outputs, not this work");
  expect_failure(2, mesh + "--window 10 --resume", "window was 8 and is 10");
  expect_failure(2, mesh + "--window 8 --odt-iterations 3 --resume",
                 "odt-iterations was 10 and is 3");
  expect_done("synth noise --shape 30,30,30 --labels 3 --seed 2 -o other.npy");
  expect_failure(2, "mesh other.npy -o n.vtu --window 8 --resume", "label fingerprint was");
  expect_done(mesh + "--window 8 --resume --report r.json");
  const json r = json::parse(read("r.json"));
  EXPECT_GT(r["engine"]["windows_resumed"], 0);
  EXPECT_GT(r["engine"]["bytes_read"], 0);
  EXPECT_EQ(read("n.vtu"), read("whole.vtu"));
  EXPECT_FALSE(files().contains("n.vtu.work"));
}

TEST_F(ResumeProgramTest, WorksInTheFolderThatIsGiven) {
  make_noise();
  interrupt("--workdir here", "here");
  EXPECT_FALSE(files().contains("n.vtu.work"));
  expect_done("mesh n.npy -o other.vtu --window 8 --workdir here --resume");
  EXPECT_FALSE(files().contains("here"));
}

/// What is meshed must be the same; where it goes, what is left out of it and how it is written
/// may change, and so may what the work is done with.
TEST_F(ResumeProgramTest, OutputMayChangeBeforeItGoesOn) {
  make_noise("22,22,22");
  const std::string other = " --labels 1 --element tet10 --names n.csv";
  write("n.csv", "label,name\n1,one\n");
  expect_done("mesh n.npy -o whole.vtu --window 8" + other);
  interrupt("--threads 1", "n.vtu.work");
  const std::string mesh = "mesh n.npy -o n.vtu --window 8 --resume";
  expect_failure(2, mesh + " --merge 1=2", "label fingerprint was");
  expect_failure(2, mesh + " --crop 0,0,0,21,22,22", "shape was 22,22,22 and is 21,22,22");
  expect_failure(2, mesh + " --spacing 1,1,1.5", "spacing was 1,1,1 and is 1,1,1.5");
  expect_done("mesh n.npy -o other.vtu --workdir n.vtu.work --window 8 --resume --threads 2" +
              other + " --memory 900MiB --report r.json");
  EXPECT_GT(json::parse(read("r.json"))["engine"]["windows_resumed"], 0);
  EXPECT_EQ(read("other.vtu"), read("whole.vtu"));
}

/// Without a change the command would be refused again.
TEST_F(ResumeProgramTest, AdvisesWhatHelpsAfterAFormatRefused) {
  make_noise("6,6,6");
  const std::string far = " --window 8 --origin 1.6e8,0,0";
  expect_done("mesh n.npy -o whole.vtu" + far);
  const ProgramRun refused = run("mesh n.npy -o n.bdf" + far);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("the work so far is in n.bdf.work; change what is written (format, "
                             "--parts) and add --workdir n.bdf.work and --resume, or delete that"),
            std::string::npos)
      << refused.err;
  expect_done("mesh n.npy -o n.vtu --workdir n.bdf.work --resume" + far);
  EXPECT_EQ(read("n.vtu"), read("whole.vtu"));
  EXPECT_FALSE(files().contains("n.bdf.work"));
}

/// Work that is damaged cannot be gone on from: the message says one thing.
TEST_F(ResumeProgramTest, AdvisesOneThingAfterDamage) {
  make_noise();
  interrupt("", "n.vtu.work");
  std::string blocks = read("n.vtu.work/blocks");
  for (std::size_t i = 0; i < blocks.size(); i += 512) blocks[i] = static_cast<char>(~blocks[i]);
  write("n.vtu.work/blocks", blocks);
  const ProgramRun damaged = run("mesh n.npy -o n.vtu --window 8 --resume");
  EXPECT_EQ(damaged.code, 3) << damaged.err;
  EXPECT_NE(damaged.err.find("n.vtu.work is damaged: delete that folder and start again"),
            std::string::npos)
      << damaged.err;
  EXPECT_EQ(damaged.err.find("--resume"), std::string::npos) << damaged.err;
  EXPECT_TRUE(files().contains("n.vtu.work"));
}

/// The partial output of a killed run goes with the next run that writes the same file.
TEST_F(ResumeProgramTest, RemovesWhatAKilledRunLeft) {
  make_noise();
  const ProgramRun killed = run("mesh n.npy -o n.vtu --window 8 --save-every 0 --report r.json",
                                "timeout --foreground -s KILL 0.8");
  ASSERT_EQ(killed.code, 137) << killed.err;
  const auto partials = [&] {
    const std::set<std::string> all = files();
    return std::count_if(all.begin(), all.end(), [](const std::string& name) {
      return name.find(".partial-") != name.npos;
    });
  };
  EXPECT_EQ(partials(), 2) << "mesh and report";
  expect_done("mesh n.npy -o n.vtu --window 8 --resume --report r.json");
  EXPECT_EQ(partials(), 0);
}

TEST_F(ResumeProgramTest, StartsWhenThereIsNothingToResume) {
  make_volume();
  const ProgramRun result = run("mesh v.npy -o v.vtu --resume");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("no saved work to resume"), std::string::npos) << result.err;
}

TEST_F(ResumeProgramTest, StaysWithinTheBudgetThatItAsksFor) {
  make_noise();
  const std::string mesh = "mesh n.npy -o n.vtu --window 16 ";
  const ProgramRun refused = run(mesh + "--memory 10MiB");
  EXPECT_EQ(refused.code, 4);
  const std::string before = "is less than ";
  const std::size_t at = refused.err.find(before);
  ASSERT_NE(at, std::string::npos) << refused.err;
  const std::size_t end = refused.err.find('\n', at);
  const std::string min =
      "--memory " + refused.err.substr(at + before.size(), end - at - before.size());
  EXPECT_EQ(files(), (std::set<std::string>{"n.npy"}));
  ProgramRun done = run(mesh + min + " --report r.json");
  if (done.code == 4) {  // a window of the second march needs more than the first of the first
    const std::size_t next = done.err.find("--memory ");
    ASSERT_NE(next, std::string::npos) << done.err;
    done = run(mesh + "--resume --report r.json " +
               done.err.substr(next, done.err.find(';', next) - next));
  }
  ASSERT_EQ(done.code, 0) << done.err;
  const json r = json::parse(read("r.json"));
  EXPECT_LE(r["engine"]["peak_accounted_bytes"], r["engine"]["memory_budget_bytes"]);
  if (!mw::test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
  EXPECT_LE(r["performance"]["peak_rss_bytes"], r["engine"]["memory_budget_bytes"]);
}

}  // namespace
}  // namespace mw::cli
