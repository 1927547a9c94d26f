// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bytes on disk through mappings: they come back, full disks are errors, nothing stays mapped.
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "engine/store/journal/mapped_file.h"
#include "engine/store/memory_budget.h"
#include "kernels/core/error.h"
#include "tests/engine/store/work_folder.h"
#include "tests/expect_error.h"

namespace mw::engine {
namespace {

using Bytes = std::vector<std::byte>;

class MappedFileTest : public test::FolderTest {
 protected:
  [[nodiscard]] std::filesystem::path path() const { return folder() / "blocks"; }
};

Bytes random_bytes(std::mt19937& random, std::size_t size) {
  Bytes bytes(size);
  for (std::byte& b : bytes) b = static_cast<std::byte>(random());
  return bytes;
}

Bytes read(const WorkFile& file, std::uint64_t offset, std::uint64_t size) {
  Bytes out;
  file.read(offset, size, [&](std::span<const std::byte> b) { out.assign(b.begin(), b.end()); });
  return out;
}

/// Bytes of file pages that are mapped into this process and resident.
std::uint64_t mapped_bytes() {
  std::uint64_t total = 0, resident = 0, shared = 0;
  std::ifstream("/proc/self/statm") >> total >> resident >> shared;
  return shared * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

TEST_F(MappedFileTest, GivesBackWhatWasWritten) {
  std::mt19937 random(351);
  Bytes expected;
  for (int session = 0; session < 4; ++session) {
    MappedFile file(path());
    ASSERT_EQ(file.size(), expected.size());
    expected.resize(expected.size() + 1 + random() % (3 * MappedFile::kMappedAtOnce));
    file.resize(expected.size());
    for (int i = 0; i < 20; ++i) {
      const std::size_t size = random() % expected.size();
      const std::size_t offset = random() % (expected.size() - size);
      const Bytes bytes = random_bytes(random, size);
      file.write(offset, bytes);
      std::copy(bytes.begin(), bytes.end(), expected.begin() + static_cast<long>(offset));
      file.prefetch(offset, size);
      ASSERT_EQ(read(file, offset, size), bytes);
    }
    file.sync();
    ASSERT_EQ(read(file, 0, expected.size()), expected);
  }
  MappedFile file(path());
  file.resize(10);
  file.resize(100);
  expected.resize(10);
  expected.resize(100);
  EXPECT_EQ(read(file, 0, 100), expected) << "new bytes are 0";
}

TEST_F(MappedFileTest, HasItsSpaceReserved) {
  MappedFile file(path());
  file.resize(3'000'000);
  struct stat facts {};
  ASSERT_EQ(::stat(path().c_str(), &facts), 0);
  EXPECT_GE(facts.st_blocks * 512, 3'000'000);
}

TEST_F(MappedFileTest, LeavesNothingMapped) {
  constexpr std::uint64_t kBytes = 64 << 20;
  MappedFile file(path());
  file.resize(kBytes);
  const std::uint64_t before = mapped_bytes();
  file.write(0, Bytes(kBytes, std::byte{7}));
  (void)read(file, 0, kBytes / 2);
  EXPECT_LT(mapped_bytes(), before + (4 << 20));
}

/// In a child whose files may not grow beyond a limit, as on a full disk: an error, no signal.
TEST_F(MappedFileTest, EndsInAnErrorWhenThereIsNoSpace) {
  const pid_t child = ::fork();
  if (child == 0) {
    (void)::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1 << 20, 1 << 20};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      MappedFile file(path());
      file.resize(1 << 20);
      file.write(0, Bytes(1 << 20, std::byte{1}));
      file.resize(2 << 20);
    } catch (const Error& e) {
      const bool told =
          std::string(e.what()).find("blocks: cannot reserve space") != std::string::npos;
      ::_exit(e.kind() == ErrorKind::kResource && told ? 42 : 1);
    }
    ::_exit(2);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 42) << status;
}

// The budget: sums by purpose, peaks, refusals, and never over the limit, however many ask at once.

using Reservation = MemoryBudget::Reservation;

TEST(MemoryBudget, AccountsByPurposeAndRemembersPeaks) {
  MemoryBudget budget(100);
  {
    const Reservation blocks = budget.reserve(Purpose::kBlocks, 30);
    const Reservation window = budget.reserve(Purpose::kWindows, 50);
    EXPECT_EQ(budget.used(), 80U);
    EXPECT_EQ(budget.used(Purpose::kBlocks), 30U);
    EXPECT_FALSE(budget.try_reserve(Purpose::kOutput, 21));
    EXPECT_TRUE(budget.try_reserve(Purpose::kOutput, 20));
    EXPECT_EQ(budget.used(Purpose::kOutput), 0U);
  }
  EXPECT_EQ(budget.used(), 0U);
  EXPECT_EQ(budget.peak(), 100U);
  EXPECT_EQ(budget.peak(Purpose::kBlocks), 30U);
  EXPECT_EQ(budget.peak(Purpose::kWindows), 50U);
  EXPECT_EQ(budget.peak(Purpose::kOutput), 20U);
}

TEST(MemoryBudget, ReservationsMove) {
  MemoryBudget budget(10);
  Reservation a = budget.reserve(Purpose::kWindows, 4);
  Reservation b = std::move(a);
  EXPECT_EQ(budget.used(), 4U);
  a = budget.reserve(Purpose::kWindows, 5);
  EXPECT_EQ(budget.used(), 9U);
  b = std::move(a);
  EXPECT_EQ(budget.used(), 5U);
  EXPECT_EQ(b.bytes(), 5U);
  b = Reservation();
  EXPECT_EQ(budget.used(), 0U);
}

TEST(MemoryBudget, CarvesWithoutAskingForMore) {
  MemoryBudget budget(100);
  Reservation window = budget.reserve(Purpose::kWindows, 100);
  {
    const Reservation block = budget.carve(window, Purpose::kBlocks, 30);
    EXPECT_EQ(block.bytes(), 30U);
    EXPECT_EQ(window.bytes(), 70U);
    EXPECT_EQ(budget.used(Purpose::kBlocks), 30U);
    EXPECT_EQ(budget.used(), 100U);
    window = Reservation();
    EXPECT_EQ(budget.used(), 30U);
  }
  EXPECT_EQ(budget.used(), 0U);
  EXPECT_EQ(budget.peak(), 100U);
}

TEST(MemoryBudget, SaysTheLeastThatWorks) {
  constexpr std::uint64_t kMebibyte = 1 << 20;
  MemoryBudget budget(10 * kMebibyte);
  const Reservation index = budget.reserve(Purpose::kIndex, 3 * kMebibyte);
  const Reservation blocks = budget.reserve(Purpose::kBlocks, 5 * kMebibyte);
  EXPECT_EQ(budget.min_with(8 * kMebibyte), 11 * kMebibyte);
  expect_error(ErrorKind::kResource, {"--memory 11MiB"},
               [&] { (void)budget.reserve(Purpose::kWindows, 8 * kMebibyte - 1); });
}

TEST(MemoryBudget, HoldsUnderManyThreads) {
  MemoryBudget budget(1000);
  std::atomic<std::uint64_t> held = 0;
  std::atomic<bool> over = false;
  const auto work = [&](unsigned seed) {
    std::mt19937 random(seed);
    for (int i = 0; i < 5000; ++i) {
      const std::uint64_t bytes = random() % 600;
      const auto r = budget.try_reserve(static_cast<Purpose>(random() % kPurposes), bytes);
      if (!r) continue;
      if (held += bytes; held > 1000) over = true;
      held -= bytes;
    }
  };
  std::vector<std::thread> threads;
  for (unsigned seed = 1; seed <= 4; ++seed) threads.emplace_back(work, seed);
  for (std::thread& t : threads) t.join();
  EXPECT_FALSE(over);
  EXPECT_EQ(budget.used(), 0U);
  EXPECT_LE(budget.peak(), 1000U);
}

}  // namespace
}  // namespace mw::engine
