// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whole records come back, and the first that is not whole ends the journal.
#include "engine/store/journal/journal.h"

#include <gtest/gtest.h>

#include "kernels/core/error.h"
#include "tests/engine/store/random_blocks.h"
#include "tests/engine/store/volatile_files.h"

namespace mw::engine {
namespace {

using test::random_number;
using test::VolatileFiles;

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
  try {
    const Journal journal(files.open("journal"));
    ADD_FAILURE() << "took it";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kInput);
  }
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

}  // namespace
}  // namespace mw::engine
