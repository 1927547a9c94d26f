// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The part of a file that a request asks for.
#include "engine/cli/serve/byte_range.h"

#include "tests/testing.h"

namespace mw::cli {
namespace {

using Pair = std::pair<std::uint64_t, std::uint64_t>;

std::optional<Pair> asked(std::string_view header, std::uint64_t size) {
  const std::optional<ByteRange> range = asked_range(header, size);
  if (!range) return std::nullopt;
  return Pair{range->begin, range->end};
}

TEST(ByteRange, IsWithinTheFile) {
  EXPECT_EQ(asked("bytes=3-17", 100), (Pair{3, 18}));
  EXPECT_EQ(asked("bytes=0-0", 100), (Pair{0, 1}));
  EXPECT_EQ(asked("bytes=9-", 100), (Pair{9, 100}));
  EXPECT_EQ(asked("bytes=90-99", 100), (Pair{90, 100}));
  EXPECT_EQ(asked("bytes=90-100", 100), (Pair{90, 100}));
  EXPECT_EQ(asked("bytes=0-18446744073709551615", 100), (Pair{0, 100}));
  EXPECT_EQ(asked("bytes=-5", 100), (Pair{95, 100}));
  EXPECT_EQ(asked("bytes=-101", 100), (Pair{0, 100}));
}

TEST(ByteRange, IsEmptyWhereTheFileHasNoneOfIt) {
  for (const char* header : {"bytes=100-", "bytes=100-200", "bytes=-0",
                             "bytes=18446744073709551615-18446744073709551615"}) {
    const std::optional<ByteRange> range = asked_range(header, 100);
    ASSERT_TRUE(range) << header;
    EXPECT_TRUE(range->empty()) << header;
    EXPECT_LE(range->end, 100U) << header;
  }
  EXPECT_EQ(asked("bytes=0-", 0), (Pair{0, 0}));
  EXPECT_EQ(asked("bytes=-5", 0), (Pair{0, 0}));
}

TEST(ByteRange, OtherHeadersAskForNothing) {
  for (const char* header : {"",
                             "bytes",
                             "bytes=",
                             "bytes=-",
                             "bytes=x-",
                             "bytes=1-x",
                             "bytes=17-3",
                             "bytes=1",
                             "bytes=1-2,4-5",
                             "bytes=0-,0-",
                             "bytes=--5",
                             "bytes=1--5",
                             "bytes=+1-5",
                             "bytes= 1-5",
                             "bytes=1-5 ",
                             "lines=1-5",
                             "-5",
                             "bytes=18446744073709551616-",
                             "bytes=0-18446744073709551616",
                             "bytes=-18446744073709551616"}) {
    EXPECT_FALSE(asked_range(header, 100)) << header;
  }
}

}  // namespace
}  // namespace mw::cli
