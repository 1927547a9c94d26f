// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Gzip data are unpacked as far as they are asked for, and read by region.
#include <thread>

#include "io/file/source/byte_source.h"
#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

std::string random_text(std::size_t size) {
  std::mt19937 random(5);
  std::string out;
  while (out.size() < size) {
    out += std::string(random() % 300, static_cast<char>('a' + random() % 26));
  }
  return out;
}

std::string read_text(const ByteSource& source, std::uint64_t offset, std::size_t length) {
  std::string out(length, '\0');
  source.read_at(offset, std::as_writable_bytes(std::span(out)));
  return out;
}

/// Two million bytes, damaged behind half of them: a reader that gets that far reports it.
std::string damaged_behind_half(const std::string& content) {
  std::string packed = gzip(content.substr(0, content.size() / 2));
  std::string rest = gzip(content.substr(content.size() / 2));
  for (std::size_t i = 20; i < rest.size(); ++i) rest[i] = '\xff';
  return packed + rest;
}

TEST(InflatedSource, AnyPlaceInAnyOrder) {
  const TempDir dir;
  const std::string content = random_text(3 << 20);
  const auto path =
      dir.file("a.gz", gzip(content.substr(0, 999'999)) + gzip(content.substr(999'999)));
  std::mt19937 random(6);
  for (int trial = 0; trial < 5; ++trial) {
    const auto source = open_bytes(path);
    for (int i = 0; i < 40; ++i) {
      const std::size_t offset = random() % content.size();
      const std::size_t length = random() % 200'000;
      if (random() % 4 == 0) {
        EXPECT_EQ(source->size_within(offset), offset);
      } else if (offset + length > content.size()) {
        expect_error(ErrorKind::kInput, {"a.gz", "ends at " + std::to_string(content.size())},
                     [&] { static_cast<void>(read_text(*source, offset, length)); });
      } else {
        ASSERT_EQ(read_text(*source, offset, length), content.substr(offset, length));
      }
    }
    EXPECT_EQ(source->size_within(content.size() + 1), content.size());
    EXPECT_EQ(source->size(), content.size());
  }
}

TEST(InflatedSource, ManyThreadsReadTheSame) {
  const TempDir dir;
  const std::string content = random_text(4 << 20);
  const auto source = open_bytes(dir.file("a.gz", gzip(content)));
  std::vector<std::thread> threads;
  for (unsigned seed = 0; seed < 4; ++seed) {
    threads.emplace_back([&, seed] {
      std::mt19937 random(seed);
      for (std::size_t at = 0; at + 50'000 < content.size(); at += random() % 100'000) {
        EXPECT_EQ(read_text(*source, at, 50'000), content.substr(at, 50'000));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(InflatedSource, DoesNotGoBeyondWhatIsAskedFor) {
  const TempDir dir;
  const std::string content = random_text(4 << 20);
  const auto source = open_bytes(dir.file("a.gz", damaged_behind_half(content)));
  const std::size_t half = content.size() / 2;
  EXPECT_EQ(read_text(*source, 1'000'000, 500), content.substr(1'000'000, 500));
  EXPECT_EQ(source->size_within(half - (1 << 19)), half - (1 << 19));
  for (int again = 0; again < 2; ++again) {
    expect_error(ErrorKind::kInput, {"a.gz", "corrupt"},
                 [&] { static_cast<void>(source->size()); });
  }
  EXPECT_EQ(read_text(*source, 0, 500), content.substr(0, 500));
}

/// A few bytes that would be many on the disk.
TEST(InflatedSource, UnpacksNoMoreThanItMay) {
  const TempDir dir;
  constexpr std::size_t kMax = 3 << 20;
  const std::string fits = random_text(kMax).substr(0, kMax);
  for (const std::size_t more : {std::size_t{0}, std::size_t{1}, std::size_t{60} << 20}) {
    const auto path = dir.file("a.gz", gzip(fits + std::string(more, 'x')));
    const InflatedSource source(std::make_unique<FileSource>(path), 0, kMax);
    EXPECT_EQ(read_text(source, 1'000'000, 500), fits.substr(1'000'000, 500));
    if (more == 0) {
      EXPECT_EQ(source.size(), kMax);
      continue;
    }
    for (int again = 0; again < 2; ++again) {
      expect_error(ErrorKind::kResource, {"a.gz", "more than 3145728 bytes", "TMPDIR"},
                   [&] { static_cast<void>(source.size()); });
    }
    EXPECT_LE(std::filesystem::file_size(path), 5U << 20);
  }
}

TEST(InflatedSource, LeavesSomeOfTheDisk) {
  const std::uint64_t free = std::filesystem::space(scratch_folder()).available;
  EXPECT_LT(room_to_inflate(), free - free / 10);
}

TEST(InflatedSource, WhatIsNoGzipIsRefused) {
  const TempDir dir;
  const auto path = dir.file("a", "0123456789");
  for (const std::uint64_t offset : {std::uint64_t{0}, std::uint64_t{9}, ~std::uint64_t{0}}) {
    expect_error(ErrorKind::kInput, {"no gzip data at offset"},
                 [&] { const InflatedSource source(std::make_unique<FileSource>(path), offset); });
  }
}

TEST(ReadWhole, IsNothingWhenThereIsMore) {
  const TempDir dir;
  const auto plain = open_bytes(dir.file("a", "0123456789"));
  const auto packed = open_bytes(dir.file("a.gz", gzip("0123456789")));
  for (const ByteSource* source : {plain.get(), packed.get()}) {
    EXPECT_EQ(read_whole(*source, 10), "0123456789");
    EXPECT_EQ(read_whole(*source, 9), std::nullopt);
  }
}

// Lines, characters and bytes by turns, across the ends of the buffer.

TEST(ByteCursor, TakesEveryByteOnceWhateverIsAsked) {
  const TempDir dir;
  std::mt19937 random(3);
  std::string content;
  while (content.size() < 3 << 20) {
    content += std::string(random() % 5000, static_cast<char>('a' + random() % 26)) + "\n";
  }
  const auto source = open_bytes(dir.file("a", content));
  ByteCursor cursor(*source);
  std::string found;
  std::string line;
  std::vector<std::byte> bytes;
  while (cursor.peek() >= 0) {
    EXPECT_EQ(cursor.offset(), found.size());
    EXPECT_EQ(cursor.left(content.size()), content.size() - found.size());
    EXPECT_EQ(cursor.left(1), 1);
    const std::uint64_t what = random() % 3;
    if (what == 0) {
      found.push_back(static_cast<char>(cursor.peek()));
      cursor.take();
    } else if (what == 1) {
      const std::uint64_t before = cursor.offset();
      ASSERT_TRUE(cursor.read_line(line, 2000));
      found += line;
      if (cursor.offset() - before > line.size()) found.push_back('\n');
    } else {
      bytes.resize(random() % 100'000);
      const bool enough = bytes.size() <= cursor.left(bytes.size());
      EXPECT_EQ(cursor.read(bytes), enough);
      if (!enough) continue;
      for (const std::byte byte : bytes) found.push_back(static_cast<char>(byte));
    }
  }
  EXPECT_TRUE(found == content);
  EXPECT_FALSE(cursor.read_line(line, 10));
}

TEST(ByteCursor, LinesOfBothKindsAreCounted) {
  const TempDir dir;
  const auto source = open_bytes(dir.file("a", "one\r\n\ntwo"));
  ByteCursor cursor(*source);
  std::string line;
  for (const char* expected : {"one", "", "two"}) {
    ASSERT_TRUE(cursor.read_line(line, 10));
    EXPECT_EQ(line, expected);
  }
  EXPECT_EQ(cursor.line(), 3U);
}

TEST(ByteCursor, ReturnsWithinALineAreKept) {
  const TempDir dir;
  const auto source = open_bytes(dir.file("a", "on\re\r\n"));
  ByteCursor cursor(*source);
  std::string line;
  for (const char* expected : {"on\r", "e"}) {
    ASSERT_TRUE(cursor.read_line(line, 3));
    EXPECT_EQ(line, expected);
  }
}

}  // namespace
}  // namespace mw::io
