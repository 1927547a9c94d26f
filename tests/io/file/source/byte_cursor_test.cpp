// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lines, characters and bytes by turns, across the ends of the buffer.
#include "io/file/source/byte_cursor.h"

#include <random>

#include "io/file/source/inflated_source.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

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

}  // namespace
}  // namespace mw::io
