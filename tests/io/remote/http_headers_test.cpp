// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Headers as servers send them.
#include "io/remote/http_headers.h"

#include <gtest/gtest.h>

namespace mw::io {
namespace {

HttpHeaders headers_of(std::initializer_list<std::string_view> lines) {
  HttpHeaders out;
  for (const std::string_view line : lines) out.add(line);
  return out;
}

TEST(HttpHeaders, AreThoseOfTheLastAnswer) {
  const HttpHeaders found =
      headers_of({"HTTP/1.1 302 Found\r\n", "ETag: \"old\"\r\n", "\r\n", "HTTP/1.1 200 OK\r\n",
                  "CONTENT-LENGTH:  12 \r\n", "Last-Modified: Mon\r\n"});
  EXPECT_EQ(found.status, 200);
  EXPECT_EQ(found.content_length, "12");
  EXPECT_EQ(found.version(), "Mon");
}

TEST(HttpHeaders, TellTheEndOfABodyFromABreak) {
  EXPECT_FALSE(headers_of({"HTTP/1.1 200 OK"}).has_end());
  EXPECT_TRUE(headers_of({"HTTP/2 200"}).has_end());
  EXPECT_TRUE(headers_of({"HTTP/1.1 200 OK", "Content-Length: 5"}).has_end());
  EXPECT_TRUE(headers_of({"HTTP/1.1 200 OK", "Transfer-Encoding: Chunked"}).has_end());
}

TEST(HttpHeaders, ArePackedUnlessTheySayIdentityOrNothing) {
  EXPECT_FALSE(headers_of({"HTTP/1.1 200 OK"}).is_packed());
  EXPECT_FALSE(headers_of({"HTTP/1.1 200 OK", "Content-Encoding: Identity"}).is_packed());
  EXPECT_TRUE(headers_of({"HTTP/1.1 200 OK", "Content-Encoding: gzip"}).is_packed());
}

TEST(HttpHeaders, SayWhichPartOfAFileComes) {
  const auto part = parse_content_range("bytes 2-15/1024");
  ASSERT_TRUE(part.has_value());
  EXPECT_EQ(part->first, 2U);
  EXPECT_EQ(part->last, 15U);
  EXPECT_EQ(part->file_bytes, 1024U);
  for (const char* text : {"", "bytes 5-4/9", "bytes 0-9/9", "bytes 0-3/*", "bytes 0-3/9x",
                           "bytes -3/9", "0-3/9", "bytes 0-99999999999999999999/9"}) {
    EXPECT_FALSE(parse_content_range(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace mw::io
