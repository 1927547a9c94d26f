// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the client makes of each status: no answer but 404 is a file that is not there.
#include "io/remote/http_client.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>

#include "io/file/errors.h"
#include "io/remote/wait_stop.h"
#include "tests/expect_error.h"
#include "tests/io/remote/one_answer.h"

namespace mw::io {
namespace {

std::string answer_of(int status, const std::string& body, const std::string& header = {}) {
  return text("HTTP/1.1 ", status, " Words\r\nConnection: close\r\n", header,
              "Content-Length: ", body.size(), "\r\n\r\n", body);
}

class TextSink : public BodySink {
 public:
  void restart() override { text_.clear(); }
  void take(std::span<const std::byte> bytes) override {
    for (const std::byte b : bytes) text_ += static_cast<char>(b);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

constexpr std::uint64_t kMax = 1 << 20;

HttpLimits quick() {
  return {.attempts = 3,
          .first_wait = std::chrono::milliseconds(1),
          .max_wait = std::chrono::seconds(0)};
}

void expect_unasked_part(const std::string& answer) {
  const OneAnswer server(answer);
  const HttpClient client(quick());
  TextSink body;
  const std::vector<std::string> pieces{server.address(), "status 206", "3 attempts"};
  expect_error(ErrorKind::kInput, pieces, [&] { (void)client.get(server.address(), kMax, body); });
  expect_error(ErrorKind::kInput, pieces,
               [&] { (void)client.probe(server.address(), kMax, body); });
  EXPECT_EQ(server.requests(), 6);
}

TEST(HttpClientTest, APartThatNobodyAskedForIsNoMissingFile) {
  const std::string body(100, 'x');
  expect_unasked_part(answer_of(206, body, "Content-Range: bytes 0-99/100\r\n"));
  expect_unasked_part(answer_of(206, body, "Content-Range: bytes 0-99/32768\r\n"));
  expect_unasked_part(answer_of(206, body));
  expect_unasked_part(answer_of(206, ""));
  expect_unasked_part(answer_of(206, std::string(1 << 18, 'x')));
}

TEST(HttpClientTest, NoStatusBut404IsAFileThatIsNotThere) {
  const HttpClient client(quick());
  std::array<std::byte, 4> out{};
  for (int status = 200; status < 600; ++status) {
    const OneAnswer server(answer_of(status, status == 204 || status == 304 ? "" : "body"));
    TextSink body;
    const auto get = [&] { return client.get(server.address(), kMax, body); };
    const auto get_part = [&] { return client.get_part(server.address(), 0, out); };
    if (status == 404) {
      EXPECT_EQ(get(), Presence::kAbsent);
      EXPECT_FALSE(get_part());
    } else if (status == 200) {
      EXPECT_EQ(get(), Presence::kThere);
      EXPECT_EQ(body.text(), "body");
      EXPECT_TRUE(get_part());
    } else {
      EXPECT_THROW((void)get(), Error) << status;
      EXPECT_THROW((void)get_part(), Error) << status;
    }
  }
}

/// They have more bytes than are read of an error's body, which ends the transfer early.
TEST(HttpClientTest, OtherStatusesWithLongBodiesAreNamed) {
  const HttpClient client(quick());
  for (const int status : {201, 203, 410}) {
    const OneAnswer server(answer_of(status, std::string(1 << 18, 'x')));
    TextSink body;
    expect_error(ErrorKind::kInput, {text("status ", status)},
                 [&] { (void)client.get(server.address(), kMax, body); });
  }
}

TEST(HttpClientTest, TrailersWithoutEndAreGivenUp) {
  std::string lines, bytes;
  while (lines.size() < 30'000) lines += "X: y\r\n";
  while (bytes.size() < 300'000) bytes += "X: " + std::string(1000, 'y') + "\r\n";
  const HttpClient client(quick());
  for (const std::string& more : {std::string("X: y\r\n"), lines, bytes}) {
    const OneAnswer server(
        "HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n4\r\nbody\r\n0\r\n" + more + "\r\n");
    TextSink body;
    std::array<std::byte, 4> out{};
    const auto get = [&] { return client.get(server.address(), kMax, body); };
    if (more != lines && more != bytes) {
      EXPECT_EQ(get(), Presence::kThere);
      EXPECT_TRUE(client.get_part(server.address(), 0, out));
      continue;
    }
    const std::vector<std::string> pieces{server.address(), "4,000 lines of headers", "3 attempts"};
    expect_error(ErrorKind::kInput, pieces, [&] { (void)get(); });
    expect_error(ErrorKind::kInput, pieces,
                 [&] { (void)client.get_part(server.address(), 0, out); });
  }
}

TEST(HttpClientTest, AWaitForTheNextAttemptEndsWhenItIsAskedTo) {
  const HttpClient client(HttpLimits{.attempts = 2});
  const OneAnswer server(answer_of(503, "", "Retry-After: 60\r\n"));
  const WaitStop::Stop stop = [&] {
    if (server.requests() > 0) throw std::string("stopped");
  };
  const WaitStop waits(&stop);
  TextSink body;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW((void)client.get(server.address(), kMax, body), std::string);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

}  // namespace
}  // namespace mw::io
