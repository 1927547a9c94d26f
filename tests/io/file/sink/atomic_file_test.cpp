// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An output file appears whole or not at all.
#include "io/file/sink/atomic_file.h"

#include <sys/resource.h>

#include <csignal>

#include "io/file/source/file_source.h"
#include "tests/io/test_files.h"

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

}  // namespace
}  // namespace mw::io
