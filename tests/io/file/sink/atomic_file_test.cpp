// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An output file appears whole or not at all.
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

#include "io/file/sink/atomic_file.h"
#include "io/file/sink/partial_file.h"
#include "io/file/source/file_source.h"
#include "tests/io/test_files.h"
#include "tests/sanitizers.h"

namespace mw::io {
namespace {

TEST(AtomicFile, AppearsOnCommitOnly) {
  const TempDir dir;
  const auto path = dir.path() / "out.bin";
  {
    AtomicFile file(path);
    file.append("hello ");
    file.append(std::string(3 << 20, 'x'));
    file.append("world");
    const std::string patch = "HELLO";
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_EQ(file.appended(), (3U << 20) + 11);
    file.write_at(0, std::as_bytes(std::span(patch)));
    file.commit();
  }
  EXPECT_EQ(content_of(path), "HELLO " + std::string(3 << 20, 'x') + "world");
  EXPECT_EQ(dir.entries(), 1U);
}

TEST(AtomicFile, LeavesNothingBehindAndKeepsTheOldFile) {
  const TempDir dir;
  const auto path = dir.file("out.bin", "old");
  { AtomicFile(path).append("new"); }
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(dir.entries(), 1U);
}

TEST(AtomicFile, WritesThroughALink) {
  const TempDir dir;
  const auto real = dir.file("real.bin", "old");
  std::filesystem::create_symlink("real.bin", dir.path() / "link.bin");
  AtomicFile file(dir.path() / "link.bin");
  file.append("new");
  file.commit();
  EXPECT_EQ(content_of(real), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(dir.path() / "link.bin"));
}

TEST(AtomicFile, MakesTheFileThatALinkNames) {
  const TempDir dir;
  std::filesystem::create_directory(dir.path() / "sub");
  std::filesystem::create_symlink("sub/next.bin", dir.path() / "link.bin");
  std::filesystem::create_symlink("real.bin", dir.path() / "sub/next.bin");
  AtomicFile file(dir.path() / "link.bin");
  file.append("new");
  file.commit();
  EXPECT_EQ(content_of(dir.path() / "sub/real.bin"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(dir.path() / "link.bin"));
  EXPECT_TRUE(std::filesystem::is_symlink(dir.path() / "sub/next.bin"));
}

TEST(AtomicFile, RefusesPathsThatCannotBeWritten) {
  const TempDir dir;
  expect_error(ErrorKind::kUsage, {"nowhere/out.bin"},
               [&] { AtomicFile file(dir.path() / "nowhere/out.bin"); });
  expect_error(ErrorKind::kUsage, {dir.path().string()}, [&] { AtomicFile file(dir.path()); });
  expect_error(ErrorKind::kUsage, {"/dev/null"}, [&] { AtomicFile file("/dev/null"); });
}

TEST(AtomicFile, WritesOverWhatWasAppendedReadsBackAndResizes) {
  const TempDir dir;
  AtomicFile file(dir.path() / "out.bin");
  file.append("0123456789");
  file.write_at(3, std::as_bytes(std::span(std::string_view("abc"))));
  file.append("!");
  std::string read(4, '?');
  file.read_at(2, std::as_writable_bytes(std::span(read)));
  EXPECT_EQ(read, "2abc");
  file.read_at(8, std::as_writable_bytes(std::span(read)));
  EXPECT_EQ(read, std::string("89\0\0", 4));
  file.resize(7);
  file.read_at(5, std::as_writable_bytes(std::span(read)));
  EXPECT_EQ(read, std::string("c6\0\0", 4));
  file.commit();
  EXPECT_EQ(content_of(dir.path() / "out.bin"), std::string("012abc6\0\0\0!", 11));
}

/// The limit on the size of files stands in for a full disk.
TEST(AtomicFile, OutOfRoomIsAResourceErrorAndLeavesNothing) {
  const TempDir dir;
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  const rlimit small{.rlim_cur = 1 << 16, .rlim_max = old.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  expect_error(ErrorKind::kResource, {"out.bin", "cannot write"}, [&] {
    AtomicFile file(dir.path() / "out.bin");
    file.append(std::string(1 << 20, 'x'));
    file.commit();
  });
  setrlimit(RLIMIT_FSIZE, &old);
  static_cast<void>(std::signal(SIGXFSZ, old_handler));
  EXPECT_EQ(dir.entries(), 0U);
}

TEST(FileSource, ShortReadNamesFileOffsetAndLength) {
  const TempDir dir;
  const FileSource source(dir.file("a.bin", "12345"));
  std::array<std::byte, 4> bytes{};
  source.read_at(1, bytes);
  EXPECT_EQ(bytes[3], std::byte{'5'});
  expect_error(ErrorKind::kInput, {"a.bin", "4 bytes", "offset 2", "ends at 5"},
               [&] { source.read_at(2, bytes); });
}

TEST(TooManyOpenFiles, AreNoBadInput) {
  if (!mw::test::kOpenFilesAreOurs) GTEST_SKIP() << "sanitizers open files";
  const TempDir dir;
  const auto path = dir.file("a.bin", "12345");
  rlimit usual{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &usual), 0);
  const rlimit none{.rlim_cur = 0, .rlim_max = usual.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  expect_error(ErrorKind::kResource, {"a.bin", "ulimit -n"}, [&] { FileSource source(path); });
  expect_error(ErrorKind::kResource, {"b.bin", "ulimit -n"},
               [&] { AtomicFile file(dir.path() / "b.bin"); });
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &usual), 0);
  EXPECT_EQ(FileSource(path).size(), 5U);
}

// What killed runs leave is removed, and nothing else.

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

/// The file system takes 255 bytes, which the name of a partial file must not exceed either.
TEST(PartialFile, NamesMayBeAsLongAsTheFileSystemTakesThem) {
  for (const std::size_t length : {214U, 215U, 239U, 255U}) {
    const std::string stem(length - 5, 'n');
    std::string letters;
    while (letters.size() + 2 < length - 4) letters += "ß";
    for (const std::string& name : {stem + "a.vtu", letters + ".vtu"}) {
      const TempDir dir;
      in_killed_process([&] { new AtomicFile(dir.path() / name); });
      EXPECT_EQ(dir.entries(), 1U) << name;
      {
        const AtomicFile other(dir.path() / (stem + "b.vtu"));
        EXPECT_EQ(dir.entries(), 2U) << "another file's stays";
      }
      AtomicFile file(dir.path() / name);
      EXPECT_EQ(dir.entries(), 1U) << "the new one alone";
      file.append("whole");
      file.commit();
      EXPECT_EQ(content_of(dir.path() / name), "whole");
    }
  }
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
