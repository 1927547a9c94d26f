// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The work folder is one run's at a time, and saved work is neither lost nor mixed up.
#include "engine/store/journal/workdir.h"

#include <algorithm>
#include <fstream>

#include "engine/store/journal/journal.h"
#include "kernels/core/error.h"
#include "tests/engine/store/work_folder.h"

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSettings = "window = 32\nstart = octree\n";

class WorkdirTest : public test::FolderTest {
 protected:
  [[nodiscard]] fs::path path() const { return folder() / "v.vtu.work"; }

  void expect_refused(bool resume, const std::string& settings, const std::string& piece) const {
    try {
      const Workdir workdir(path(), resume, settings);
      ADD_FAILURE() << "took it";
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kUsage);
      EXPECT_NE(std::string(e.what()).find(piece), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("v.vtu.work"), std::string::npos) << e.what();
    }
  }

  static void save_something(Workdir& workdir) {
    Journal journal(workdir.open(kJournalFile));
    journal.replay([](const JournalRecord&) {});
    journal.append({.windows = {1, 2}, .blocks = {}});
  }

  /// What a run that ended early leaves behind.
  void leave_work() const {
    Workdir workdir(path(), false, kSettings);
    save_something(workdir);
    workdir.keep();
  }
};

TEST_F(WorkdirTest, GoesWithTheRun) {
  {
    Workdir workdir(path(), false, kSettings);
    EXPECT_FALSE(workdir.resumes());
    save_something(workdir);
    EXPECT_TRUE(fs::exists(path() / "settings.txt"));
  }
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(WorkdirTest, StaysWhenKeptUntilARunFromItIsDone) {
  leave_work();
  expect_refused(false, kSettings, "add --resume");
  { EXPECT_TRUE(Workdir(path(), true, kSettings).resumes()); }
  {
    Workdir workdir(path(), true, kSettings);
    EXPECT_TRUE(workdir.resumes());
    workdir.discard();
  }
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(WorkdirTest, NamesEachDifference) {
  leave_work();
  expect_refused(true, "window = 48\nstart = octree\n", "window was 32 and is 48; give");
  expect_refused(true, "window = 8\nstart = dense\n",
                 "start was octree and is dense; window was 32 and is 8");
  expect_refused(true, "window = 32\n", "start was octree and is (not there)");
  EXPECT_TRUE(Workdir(path(), true, kSettings).resumes());
}

/// Whatever a damaged file holds, the terminal gets plain text, and not much of it.
TEST_F(WorkdirTest, DoesNotEchoDamagedSettings) {
  for (const std::string& damage :
       {std::string("window = \x1b[2J\x07\n"), std::string(1 << 20, 'x'), std::string(),
        std::string("window = 32\nstart = octree\nstar"), std::string(100, '\0')}) {
    leave_work();
    std::ofstream(path() / "settings.txt", std::ios::binary) << damage;
    expect_refused(true, kSettings, "delete the folder to start again");
    try {
      const Workdir workdir(path(), true, kSettings);
    } catch (const Error& e) {
      const std::string message = e.what();
      EXPECT_LT(message.size(), 1000U);
      EXPECT_TRUE(std::all_of(message.begin(), message.end(), [](char c) {
        return c >= ' ' && c <= '~';
      })) << message;
    }
    fs::remove_all(path());
  }
}

TEST_F(WorkdirTest, ShowsLongValuesInPart) {
  const std::string sizes(5000, '7');
  const std::string told = differences("size = " + sizes + "\n", "size = " + sizes + "8\n");
  EXPECT_NE(told.find("size was 777"), std::string::npos) << told;
  EXPECT_LT(told.size(), 400U);
  std::string before, now;
  for (int i = 0; i < 50; ++i) before += "s" + std::to_string(i) + " = a\n";
  EXPECT_NE(differences(before, now).find("; and 42 more"), std::string::npos);
}

/// A run killed before anything was saved, at whatever moment, is in nobody's way.
TEST_F(WorkdirTest, TakesOverWhatWasNeverSaved) {
  fs::create_directory(path());
  std::ofstream(path() / "settings.txt") << "window = 4\n";
  std::ofstream(path() / ".settings.txt.partial-12-0") << "wind";
  std::ofstream(path() / "journal") << "";
  std::ofstream(path() / "blocks") << "some bytes";
  {
    const Workdir workdir(path(), false, kSettings);
    EXPECT_FALSE(workdir.resumes());
    EXPECT_FALSE(fs::exists(path() / "blocks"));
  }
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(WorkdirTest, IsLockedWhileARunIsAtWork) {
  {
    Workdir workdir(path(), false, kSettings);
    expect_refused(false, kSettings, "another mwmesh is at work here");
    expect_refused(true, kSettings, "another mwmesh is at work here");
    save_something(workdir);
    EXPECT_TRUE(fs::exists(path() / "journal")) << "the other one left it alone";
  }
  const Workdir after(path(), false, kSettings);
}

TEST_F(WorkdirTest, LeavesFilesOfOthersAlone) {
  fs::create_directory(path());
  std::ofstream(path() / "thesis.tex") << "\\begin{document}";
  expect_refused(false, kSettings, "it holds thesis.tex");
  EXPECT_TRUE(fs::exists(path() / "thesis.tex"));
  EXPECT_FALSE(fs::exists(path() / "lock"));
}

TEST_F(WorkdirTest, NeedsAFolderToBeIn) {
  std::ofstream(path()) << "a file";
  expect_refused(false, kSettings, "is not a folder");
  try {
    const Workdir workdir(folder() / "nowhere" / "w", false, kSettings);
    ADD_FAILURE() << "made it";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kUsage);
  }
}

TEST_F(WorkdirTest, TellsWhatItCannotClearAway) {
  fs::create_directories(path() / kBlocksFile / "in the way");
  try {
    const Workdir workdir(path(), false, kSettings);
    ADD_FAILURE() << "took it";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kResource);
    EXPECT_NE(std::string(e.what()).find(kBlocksFile), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace mw::engine
