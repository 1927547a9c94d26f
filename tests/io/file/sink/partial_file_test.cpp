// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What killed runs leave is removed, and nothing else.
#include "io/file/sink/partial_file.h"

#include <signal.h>
#include <sys/wait.h>

#include <functional>
#include <set>

#include "io/file/sink/atomic_file.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

namespace fs = std::filesystem;

/// Runs work in a process that then waits to be killed, and is.
void in_killed_process(const std::function<void()>& work) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const pid_t id = ::fork();
  ASSERT_GE(id, 0);
  if (id == 0) {
    work();
    [[maybe_unused]] const auto told = ::write(ends[1], "x", 1);
    while (true) ::pause();
  }
  char done = 0;
  EXPECT_EQ(::read(ends[0], &done, 1), 1);
  ::kill(id, SIGKILL);
  ::waitpid(id, nullptr, 0);
  ::close(ends[0]);
  ::close(ends[1]);
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

TEST(PartialFile, OfAKilledRunIsRemovedByTheNext) {
  const TempDir dir;
  const fs::path path = dir.path() / "m.vtu";
  in_killed_process([&] { (new AtomicFile(path))->append(std::string(3 << 20, 'x')); });
  in_killed_process([&] { (new AtomicFile(dir.path() / "other.vtu"))->append("x"); });
  EXPECT_EQ(dir.entries(), 2U) << "a kill leaves the file";
  AtomicFile next(path);
  EXPECT_EQ(dir.entries(), 2U) << "that of the other output, and the new one";
  next.append("whole");
  next.commit();
  EXPECT_EQ(content_of(path), "whole");
  EXPECT_EQ(dir.entries(), 2U);
}

TEST(PartialFile, OfALiveRunStays) {
  const TempDir dir;
  const fs::path path = dir.path() / "m.vtu";
  AtomicFile mine(path);
  mine.append("mine");
  in_killed_process([&] {
    AtomicFile other(path);
    other.append("other");
    other.commit();
  });
  EXPECT_EQ(content_of(path), "other");
  mine.commit();
  EXPECT_EQ(content_of(path), "mine");
  EXPECT_EQ(dir.entries(), 1U);
}

TEST(PartialFile, FoldersToo) {
  const TempDir dir;
  const fs::path path = dir.path() / "meshes";
  in_killed_process([&] { std::ofstream((new AtomicFolder(path))->path() / "info") << "{}"; });
  EXPECT_EQ(dir.entries(), 1U);
  AtomicFolder live(path);
  EXPECT_EQ(dir.entries(), 1U) << "the new one alone";
  in_killed_process([&] { new AtomicFolder(path); });
  EXPECT_TRUE(fs::exists(live.path()));
  live.commit();
  EXPECT_TRUE(fs::is_directory(path));
}

/// Names that are nearly ours are somebody else's.
TEST(PartialFile, FilesOfOthersStay) {
  const TempDir dir;
  in_killed_process([&] { new AtomicFile(dir.path() / "m.vtu"); });
  const std::string ours = *names_in(dir.path()).begin();
  const std::string numbers = ours.substr(std::string(".m.vtu.partial-").size() + 8);
  const std::set<std::string> others{".m.vtu.partial-12-0",
                                     ".m.vtu.partial-notes",
                                     ".m.vtu.partial-",
                                     ".m.vtu.partial-wxyzwxyz" + numbers,
                                     ".n.vtu.partial-01234567-1-0",
                                     "m.vtu.partial-01234567-1-0",
                                     ".m.vtu.partial-01234567-1-0.txt"};
  for (const std::string& name : others) dir.file(name, "thesis");
  { const AtomicFile next(dir.path() / "m.vtu"); }
  EXPECT_EQ(names_in(dir.path()), others);
}

}  // namespace
}  // namespace mw::io
