// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A log that is cut anywhere holds the records before the cut.
#include "engine/store/journal/journal.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/store/journal/mapped_file.h"
#include "tests/engine/store/volatile_files.h"
#include "tests/oracle/small_volumes.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using audit::test::below;
using mw::test::TempFolder;
using Records = std::vector<std::vector<std::byte>>;

constexpr LogKind kKind{.magic = 0x0807060504030201U, .name = "log", .expected = "it is none"};

RecordLog open(const std::filesystem::path& path) {
  return RecordLog(std::make_unique<MappedFile>(path), kKind);
}

Records replayed(RecordLog& log) {
  Records out;
  log.replay([&](std::uint64_t, std::span<const std::byte> record) {
    out.emplace_back(record.begin(), record.end());
  });
  return out;
}

Records random_records(std::mt19937& random) {
  Records out(1 + below(random, 20));
  for (auto& record : out) {
    record.resize(1 + below(random, 300));
    for (std::byte& b : record) b = static_cast<std::byte>(below(random, 256));
  }
  return out;
}

TEST(RecordLog, HoldsWhatIsWholeAfterEveryCut) {
  std::mt19937 random(3510);
  for (int i = 0; i < 40; ++i) {
    const TempFolder folder;
    const auto path = folder.path() / "log";
    const Records records = random_records(random);
    std::vector<std::uint64_t> ends;
    {
      RecordLog log = open(path);
      EXPECT_TRUE(replayed(log).empty());
      for (const auto& record : records) {
        const std::uint64_t at = log.append(record);
        log.read(at, [&](std::span<const std::byte> read) {
          EXPECT_TRUE(std::equal(read.begin(), read.end(), record.begin(), record.end()));
        });
        ends.push_back(log.bytes());
      }
    }
    const std::uint64_t cut = 8 + below(random, static_cast<std::uint32_t>(ends.back() - 7));
    std::filesystem::resize_file(path, cut);
    const auto whole = static_cast<std::size_t>(
        std::count_if(ends.begin(), ends.end(), [&](std::uint64_t end) { return end <= cut; }));
    RecordLog log = open(path);
    EXPECT_EQ(replayed(log),
              Records(records.begin(), records.begin() + static_cast<std::ptrdiff_t>(whole)));
    // What comes behind the cut is read again, and nothing old with it.
    static_cast<void>(log.append(records[0]));
    RecordLog again = open(path);
    EXPECT_EQ(replayed(again).size(), whole + 1);
  }
}

TEST(RecordLog, GrowsAgainAfterItWasTrimmed) {
  std::mt19937 random(3511);
  const TempFolder folder;
  const auto path = folder.path() / "log";
  Records written;
  for (int i = 0; i < 5; ++i) {
    RecordLog log = open(path);
    EXPECT_EQ(replayed(log), written);
    for (const auto& record : random_records(random)) {
      static_cast<void>(log.append(record));
      written.push_back(record);
    }
    log.trim();
    EXPECT_EQ(std::filesystem::file_size(path), log.bytes());
  }
}

/// What a record gives up is used again once it was replayed, so it must not go away afterwards.
TEST(RecordLog, WhatWasReplayedOnceSurvivesAPowerCut) {
  std::mt19937 random(3512);
  for (int i = 0; i < 20; ++i) {
    test::VolatileFiles files;
    const Records records = random_records(random);
    {
      RecordLog killed(files.open("log"), kKind);
      for (const auto& record : records) static_cast<void>(killed.append(record));
    }
    RecordLog log(files.open("log"), kKind);
    EXPECT_EQ(replayed(log), records);
    files.cut_power(random);
    RecordLog again(files.open("log"), kKind);
    EXPECT_EQ(replayed(again), records);
  }
}

/// A magic may end with zeros: that of a folder's log has the folder's own number in it.
TEST(RecordLog, KeepsItsRecordsWhateverItsMagic) {
  std::mt19937 random(3513);
  const TempFolder folder;
  for (unsigned zeros = 0; zeros <= 8; ++zeros) {
    const LogKind kind{.magic = zeros == 8 ? 0 : std::uint64_t{0x8DEA7956069FBB11U} << 8 * zeros,
                       .name = "log",
                       .expected = "it is another file"};
    const auto path = folder.path() / std::to_string(zeros);
    const Records records = random_records(random);
    {
      RecordLog log(std::make_unique<MappedFile>(path), kind);
      for (const auto& record : records) static_cast<void>(log.append(record));
    }
    RecordLog again(std::make_unique<MappedFile>(path), kind);
    EXPECT_EQ(replayed(again), records) << zeros << " zeros at the end";
  }
}

TEST(RecordLog, RefusesAnotherFile) {
  const TempFolder folder;
  const auto path = folder.path() / "log";
  std::ofstream(path) << "something else entirely";
  EXPECT_THROW(open(path), DamagedWork);
}

}  // namespace
}  // namespace mw::engine
