// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whole records come back, and the first that is not whole ends the journal.
#include "engine/store/journal/journal.h"
#include "engine/store/journal/folder_lock.h"
#include "engine/store/journal/identity.h"
#include "engine/store/journal/run_folder.h"
#include "kernels/core/error.h"
#include "tests/engine/store/random_blocks.h"
#include "tests/engine/store/volatile_files.h"
#include "tests/engine/store/work_folder.h"
#include "tests/expect_error.h"

namespace mw::engine {
namespace {

using namespace test;

using Records = std::vector<JournalRecord>;

JournalRecord random_record(std::mt19937& random, std::size_t size) {
  JournalRecord record;
  for (std::size_t i = 1 + random() % size; i > 0; --i) {
    record.windows.push_back(random_number(random));
  }
  for (std::size_t i = random() % size; i > 0; --i) {
    record.blocks.push_back({random_number(random),
                             {random_number(random), random_number(random)},
                             static_cast<std::uint32_t>(random()),
                             random_number(random)});
  }
  return record;
}

Records replayed(Journal& journal) {
  Records out;
  journal.replay([&](const JournalRecord& r) { out.push_back(r); });
  return out;
}

Records replayed(VolatileFiles& files) {
  Journal journal(files.open("journal"));
  return replayed(journal);
}

/// Writes records and gives back where each ends in the file.
std::vector<std::size_t> write(VolatileFiles& files, const Records& records) {
  std::vector<std::size_t> ends;
  for (const JournalRecord& record : records) {
    Journal journal(files.open("journal"));
    replayed(journal);
    ends.push_back(files.content("journal").size());  // replay cuts off the zeros
    journal.append(record);
  }
  replayed(files);
  ends.push_back(files.content("journal").size());
  return ends;
}

TEST(Journal, GivesBackWhatWasAppended) {
  std::mt19937 random(331);
  VolatileFiles files;
  Records expected;
  for (int session = 0; session < 20; ++session) {
    Journal journal(files.open("journal"));
    ASSERT_EQ(replayed(journal), expected);
    for (std::size_t i = random() % 10; i > 0; --i) {
      expected.push_back(random_record(random, i == 1 ? 20000 : 20));
      journal.append(expected.back());
    }
    EXPECT_EQ(journal.records(), expected.size());
  }
}

TEST(Journal, EndsBeforeTheFirstRecordThatIsNotWhole) {
  std::mt19937 random(332);
  Records records;
  for (int i = 0; i < 5; ++i) records.push_back(random_record(random, 6));
  VolatileFiles files;
  const std::vector<std::size_t> ends = write(files, records);
  const VolatileFiles::Bytes whole = files.content("journal");
  ASSERT_EQ(whole.size(), ends.back());
  for (std::size_t at = ends.front(); at < whole.size(); ++at) {
    std::size_t before = 0;
    while (ends[before + 1] <= at) ++before;
    const Records expected(records.begin(), records.begin() + static_cast<long>(before));
    files.content("journal") = whole;
    files.content("journal")[at] ^= static_cast<std::byte>(1 + random() % 255);
    ASSERT_EQ(replayed(files), expected) << "byte " << at;
    files.content("journal") = whole;
    files.content("journal").resize(at);
    ASSERT_EQ(replayed(files), expected) << "cut at " << at;
  }
}

/// A record that was cut off leaves nothing behind that a later one could be mistaken for.
TEST(Journal, GoesOnBehindTheLastWholeRecord) {
  std::mt19937 random(333);
  const Records records{random_record(random, 5), random_record(random, 50),
                        random_record(random, 5), random_record(random, 5)};
  VolatileFiles files;
  const std::vector<std::size_t> ends = write(files, {records[0], records[1], records[2]});
  files.content("journal")[ends[1] + 9] ^= std::byte{1};
  Journal journal(files.open("journal"));
  replayed(journal);
  journal.append(records[3]);
  EXPECT_EQ(replayed(files), (Records{records[0], records[3]}));
}

/// A killed run leaves a record that its sync did not reach; who goes on from it overwrites what it
/// replaces.
TEST(Journal, WhatWasReplayedSurvivesAPowerCut) {
  std::mt19937 random(347);
  for (int trial = 0; trial < 50; ++trial) {
    VolatileFiles files;
    const Records records{random_record(random, 20), random_record(random, 20)};
    write(files, {records[0]});
    {
      Journal journal(files.open("journal"));
      replayed(journal);
      files.fail_at = files.operations + 2;  // room and bytes are there, the sync fails
      EXPECT_THROW(journal.append(records[1]), Error);
      files.fail_at = ~std::uint64_t{0};
    }
    ASSERT_EQ(replayed(files), records);
    files.cut_power(random);
    ASSERT_EQ(replayed(files), records);
  }
}

TEST(Journal, RefusesAnotherFile) {
  VolatileFiles files;
  files.content("journal").assign(100, std::byte{65});
  expect_error(ErrorKind::kInput, {}, [&] { const Journal journal(files.open("journal")); });
}

TEST(Journal, SurvivesAPowerCutAtAnyOperation) {
  std::mt19937 random(334);
  for (std::uint64_t fail_at = 0; fail_at < 40; ++fail_at) {
    VolatileFiles files;
    files.fail_at = fail_at;
    Records done, begun;
    try {
      Journal journal(files.open("journal"));
      replayed(journal);
      for (;;) {
        begun.push_back(random_record(random, 100));
        journal.append(begun.back());
        done = begun;
      }
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kResource);
    }
    files.cut_power(random);
    const Records after = replayed(files);
    EXPECT_TRUE(after == done || after == begun) << fail_at;
  }
}

// The work folder is one run's at a time, and saved work is neither lost nor mixed up.

namespace fs = std::filesystem;

constexpr const char* kSettings = "window = 32\nstart = octree\n";

class WorkdirTest : public test::FolderTest {
 protected:
  [[nodiscard]] fs::path path() const { return folder() / "v.vtu.work"; }

  void expect_refused(bool resume, const std::string& settings, const std::string& piece) const {
    expect_error(ErrorKind::kUsage, {piece, "v.vtu.work"},
                 [&] { const Workdir workdir(path(), resume, settings); });
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
    workdir.stay();
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
                 "--start was octree and is dense; --window was 32 and is 8");
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
  EXPECT_TRUE(lock_folder(path()).has_value());
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

/// The names of our files are everyday words.
TEST_F(WorkdirTest, LeavesFilesOfOthersAloneThatAreCalledLikeOurs) {
  for (const char* name : {"settings.txt", "blocks", "journal", "lock"}) {
    fs::create_directory(path());
    std::ofstream(path() / name) << "precious\n";
    expect_refused(false, kSettings, std::string("it holds ") + name);
    expect_refused(true, kSettings, std::string("it holds ") + name);
    EXPECT_TRUE(fs::exists(path() / name));
    fs::remove_all(path());
  }
}

/// A power cut leaves bytes of 0 where the mark had not reached the disk.
TEST_F(WorkdirTest, TakesOverALockWhoseMarkIsNotWhole) {
  fs::create_directory(path());
  EXPECT_TRUE(lock_folder(path()).has_value());
  std::ifstream in(path() / kLockFile);
  const std::string mark{std::istreambuf_iterator<char>(in), {}};
  ASSERT_FALSE(mark.empty());
  for (const std::string& left : {std::string(), mark.substr(0, 9), std::string(mark.size(), '\0'),
                                  mark.substr(0, 9) + std::string(mark.size() - 9, '\0')}) {
    fs::create_directory(path());
    std::ofstream(path() / kLockFile) << left;
    EXPECT_TRUE(is_of_runs(path()));
    EXPECT_TRUE(lock_folder(path()).has_value());
    std::ofstream(path() / kBlocksFile) << "some bytes";
    EXPECT_TRUE(is_of_runs(path())) << "the lock is whole again";
    { const Workdir workdir(path(), false, kSettings); }
    EXPECT_FALSE(fs::exists(path()));
  }
}

/// Sizes of very many labels make long settings.
TEST_F(WorkdirTest, GoesOnWithSettingsOfAnySize) {
  const std::string settings = "size = " + std::string(17 << 20, '1') + "\nend = 1\n";
  {
    Workdir workdir(path(), false, settings);
    Journal(workdir.open(kJournalFile)).append({});
    workdir.stay();
  }
  EXPECT_TRUE(is_identity_of(path(), settings));
  EXPECT_FALSE(is_identity_of(path(), settings.substr(0, settings.size() - 1)));
  expect_refused(true, settings + "more = 1\n", "more was (not there) and is 1");
  EXPECT_TRUE(Workdir(path(), true, settings).resumes());
}

TEST_F(WorkdirTest, LeavesALinkToTheFolder) {
  fs::create_directory(folder() / "elsewhere");
  fs::create_directory_symlink("elsewhere", path());
  { const Workdir workdir(path(), false, kSettings); }
  EXPECT_TRUE(fs::is_symlink(path()));
  EXPECT_TRUE(fs::is_empty(folder() / "elsewhere"));
}

TEST_F(WorkdirTest, NeedsAFolderToBeIn) {
  std::ofstream(path()) << "a file";
  expect_refused(false, kSettings, "is not a folder");
  expect_error(ErrorKind::kUsage, {},
               [&] { const Workdir workdir(folder() / "nowhere" / "w", false, kSettings); });
}

TEST_F(WorkdirTest, TellsWhatItCannotClearAway) {
  fs::create_directories(path());
  EXPECT_TRUE(lock_folder(path()).has_value());
  fs::create_directories(path() / kBlocksFile / "in the way");
  expect_error(ErrorKind::kResource, {kBlocksFile},
               [&] { const Workdir workdir(path(), false, kSettings); });
}

}  // namespace
}  // namespace mw::engine
