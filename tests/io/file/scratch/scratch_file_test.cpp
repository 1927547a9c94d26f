// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Temporary files: what was written is read, no name is left, and errors name the folder.
#include <fcntl.h>
#include <sys/stat.h>

#include <chrono>

#include "io/file/scratch/external_sort.h"
#include "io/file/scratch/scratch_file.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

std::vector<std::byte> random_bytes(std::mt19937& random, std::size_t count) {
  std::vector<std::byte> out(count);
  for (std::byte& b : out) b = static_cast<std::byte>(random());
  return out;
}

/// Making a name, be it for an instant, shows in the time of the folder.
TEST(UnlinkedFile, NeverHasANameWhereTheFileSystemCanDoWithout) {
  const TempDir dir;
  const FileDescriptor probe(::open(dir.path().c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
  if (!probe.valid()) GTEST_SKIP() << "files need names here";
  const auto past = std::filesystem::last_write_time(dir.path()) - std::chrono::hours(1);
  std::filesystem::last_write_time(dir.path(), past);
  const UnlinkedFile file(dir.path());
  EXPECT_EQ(std::filesystem::last_write_time(dir.path()), past);
}

TEST(UnlinkedFile, HoldsWhatWasWrittenAndHasNoName) {
  const TempDir dir;
  const UnlinkedFile file(dir.path());
  EXPECT_EQ(dir.entries(), 0U);
  std::mt19937 random(1051);
  std::vector<std::byte> expected(100000);
  file.write_at(0, expected);
  for (int i = 0; i < 300; ++i) {
    const std::size_t at = random() % expected.size();
    const std::size_t size = std::min<std::size_t>(random() % 5000, expected.size() - at);
    const std::vector<std::byte> bytes = random_bytes(random, size);
    std::ranges::copy(bytes, expected.begin() + static_cast<std::ptrdiff_t>(at));
    file.write_at(at, bytes);
  }
  for (int i = 0; i < 100; ++i) {
    const std::size_t at = random() % expected.size();
    std::vector<std::byte> found(std::min<std::size_t>(random() % 5000, expected.size() - at));
    file.read_at(at, found);
    EXPECT_TRUE(std::ranges::equal(found, std::span(expected).subspan(at, found.size())));
  }
}

TEST(UnlinkedFile, GivesTheDiskBackWhatItIsTold) {
  const TempDir dir;
  UnlinkedFile file(dir.path());
  std::mt19937 random(1053);
  const std::vector<std::byte> expected = random_bytes(random, std::size_t{1} << 20U);
  file.write_at(0, expected);
  file.give_up(100000, 800000);
  for (const auto& [at, size] :
       {std::pair<std::size_t, std::size_t>(0, 100000), {900000, 148576}}) {
    std::vector<std::byte> found(size);
    file.read_at(at, found);
    EXPECT_TRUE(std::ranges::equal(found, std::span(expected).subspan(at, size)));
  }
  const FileDescriptor handle = file.release();
  struct stat found {};
  ASSERT_EQ(::fstat(handle.get(), &found), 0);
  if (found.st_blocks * 512 >= 1 << 20) GTEST_SKIP() << "no holes on this file system";
  EXPECT_LT(found.st_blocks * 512, 300000);
}

/// Appended in pieces smaller and larger than its buffer, read while it grows.
TEST(ScratchFile, ReadsBackWhatWasAppended) {
  const TempDir dir;
  ScratchFile file(dir.path());
  std::mt19937 random(1052);
  std::vector<std::byte> expected;
  for (int i = 0; i < 60; ++i) {
    const std::size_t max = i % 10 == 9 ? 600000 : 3000;
    const std::vector<std::byte> bytes = random_bytes(random, random() % max);
    file.append(bytes);
    expected.insert(expected.end(), bytes.begin(), bytes.end());
    ASSERT_EQ(file.size(), expected.size());
    if (i % 3 != 0) continue;
    const std::size_t at = random() % (expected.size() + 1);
    std::vector<std::byte> found(random() % (expected.size() - at + 1));
    file.read_at(at, found);
    ASSERT_TRUE(std::ranges::equal(found, std::span(expected).subspan(at, found.size())));
  }
  EXPECT_EQ(dir.entries(), 0U);
}

TEST(UnlinkedFile, NamesTheFolderThatIsNotThere) {
  const TempDir dir;
  const std::filesystem::path missing = dir.path() / "missing";
  expect_error(ErrorKind::kUsage, {missing.string()}, [&] { const UnlinkedFile file(missing); });
  expect_error(ErrorKind::kUsage, {missing.string()}, [&] { const ScratchFile file(missing); });
}

TEST(UnlinkedFile, SaysSoWhenThereIsLessThanWasAskedFor) {
  const TempDir dir;
  const UnlinkedFile file(dir.path());
  std::vector<std::byte> bytes(10);
  file.write_at(0, bytes);
  expect_error(ErrorKind::kResource, {dir.path().string()}, [&] { file.read_at(5, bytes); });
}

/// Puts TMPDIR back when it goes.
class KeptTmpDir {
 public:
  KeptTmpDir() {
    if (const char* old = std::getenv("TMPDIR")) before_ = old;
  }
  ~KeptTmpDir() {
    if (before_) {
      ::setenv("TMPDIR", before_->c_str(), 1);
    } else {
      ::unsetenv("TMPDIR");
    }
  }
  KeptTmpDir(const KeptTmpDir&) = delete;
  KeptTmpDir& operator=(const KeptTmpDir&) = delete;

 private:
  std::optional<std::string> before_;
};

TEST(ScratchFolder, IsWhatTmpdirNames) {
  const KeptTmpDir kept;
  ::setenv("TMPDIR", "/somewhere", 1);
  EXPECT_EQ(scratch_folder(), "/somewhere");
  ::setenv("TMPDIR", "", 1);
  EXPECT_EQ(scratch_folder(), "/tmp");
  ::unsetenv("TMPDIR");
  EXPECT_EQ(scratch_folder(), "/tmp");
}

TEST(ScratchFolder, IsToldAsThatOfTheEnvironment) {
  const KeptTmpDir kept;
  ::setenv("TMPDIR", "/nowhere/to/be", 1);
  expect_error(ErrorKind::kUsage, {"TMPDIR=/nowhere/to/be: cannot create"},
               [] { const UnlinkedFile file(scratch_folder()); });
  try {
    const UnlinkedFile file("/nowhere/else");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("/nowhere/else: ")) << error.what();
  }
}

// Sorting with little memory gives what sorting with much does.

TEST(ExternalSort, IsStdSortForEveryBudget) {
  const TempDir dir;
  std::mt19937_64 random(341);
  for (const std::size_t count : {0U, 1U, 2U, 3U, 100U, 4096U, 20000U}) {
    std::vector<std::array<std::uint64_t, 2>> records;
    for (std::size_t i = 0; i < count; ++i) records.push_back({random() % (count + 1), random()});
    for (const std::size_t memory : {0U, 100U, 3000U, 65536U, 1U << 24}) {
      ExternalSort<2> sort(dir.path(), memory);
      for (const auto& record : records) sort.add(record);
      std::vector<std::array<std::uint64_t, 2>> sorted;
      sort.each([&](const auto& record) { sorted.push_back(record); });
      auto expected = records;
      std::sort(expected.begin(), expected.end());
      EXPECT_TRUE(sorted == expected) << count << " records, " << memory << " bytes";
    }
  }
}

TEST(ExternalSort, GivesRecordsOneByOneAndLetsOthersSortThem) {
  const TempDir dir;
  for (const std::size_t memory : {3000U, 65536U}) {
    std::size_t sorts = 0;
    ExternalSort<1> sort(dir.path(), memory, [&](std::span<std::array<std::uint64_t, 1>> held) {
      ++sorts;
      std::sort(held.begin(), held.end());
    });
    for (std::uint64_t i = 0; i < 1000; ++i) sort.add({i * 7919 % 1000});
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const std::array<std::uint64_t, 1>* const record = sort.next();
      ASSERT_NE(record, nullptr);
      EXPECT_EQ((*record)[0], i);
    }
    EXPECT_EQ(sort.next(), nullptr);
    EXPECT_EQ(sort.next(), nullptr);
    EXPECT_EQ(sorts, 1 + 8000 / (memory + 1));
  }
}

TEST(ScratchFile, GivesBackWhatWasAppendedAndLeavesNoName) {
  const TempDir dir;
  ScratchFile file(dir.path());
  std::string all;
  for (std::size_t i = 0; i < 300; ++i) {
    const std::string piece(i * 17 % 5000 + (i == 200 ? 1U << 20 : 0U),
                            static_cast<char>('a' + i % 26));
    file.append(piece);
    all += piece;
    std::string last(std::min<std::size_t>(all.size(), 9000), '\0');
    file.read_at(all.size() - last.size(), std::as_writable_bytes(std::span(last)));
    EXPECT_TRUE(all.ends_with(last));
  }
  EXPECT_EQ(file.size(), all.size());
  std::string whole(all.size(), '\0');
  file.read_at(0, std::as_writable_bytes(std::span(whole)));
  EXPECT_TRUE(whole == all);
  EXPECT_EQ(dir.entries(), 0U);
  expect_error(ErrorKind::kUsage, {"nowhere"}, [&] { ScratchFile gone(dir.path() / "nowhere"); });
}

}  // namespace
}  // namespace mw::io
