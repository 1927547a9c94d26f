// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files of a web server, whole or in parts, by libcurl.  Whatever a server does wrong, callers get
// what they asked for, or an error.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace mw::io {

/// The environment variable with the value of the header `Authorization`, such as "Bearer TOKEN".
inline constexpr const char* kAuthorizationVariable = "MW_HTTP_AUTHORIZATION";

struct HttpLimits {
  int connections = 16;  ///< at most, at a time
  int attempts = 9;      ///< of a request
  /// The wait between the first two attempts.  It doubles from then on; a wait is longer where the
  /// server asks for that, but at most max_wait.
  std::chrono::milliseconds first_wait{100};
  std::chrono::seconds max_wait{60};
  long connect_seconds = 30;
  long stalled_seconds = 30;  ///< without a kilobyte a second
  long redirects = 5;
};

/// Takes a body as it arrives, unpacked where the server packed it.
class BodySink {
 public:
  virtual ~BodySink() = default;
  /// Forgets what has come, as another attempt begins.
  virtual void restart() = 0;
  virtual void take(std::span<const std::byte> bytes) = 0;
};

enum class Presence {
  kThere,
  kAbsent,
  kTooLarge,
  kRefused,  ///< status 403, as the result of HttpClient::probe() alone
};

/// What is known of a file after a part of it has come.
struct RemotePart {
  std::uint64_t bytes = 0;       ///< of the part
  std::uint64_t file_bytes = 0;  ///< of the whole file
  std::string version;  ///< its strong ETag or else the time of its last change; may be empty
};

/// Requests are repeated, with growing waits, after 408, 416, 425, 429, 5xx, failed connections,
/// bodies that end early, wrong parts, and parts where the whole file was asked for.  The
/// authorization is that of kAuthorizationVariable, else of .netrc; it goes to the host of the
/// address only, not to where that redirects, and is in no message. ERRORS (all members):
/// mw::Error(kInput), naming the address, when the server refuses, redirects without end, or sends
/// what was not asked for; kResource when it does not answer; what the thread's WaitStop throws
/// (io/remote/wait_stop.h). Thread safety: any; more threads than connections wait for each other.
class HttpClient {
 public:
  /// ERRORS: mw::Error(kUsage) when kAuthorizationVariable has more than one line.
  explicit HttpClient(const HttpLimits& limits = {});
  ~HttpClient();
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  /// Fetches a file; a body of more than max bytes, unpacked, is given up while it arrives.
  /// ENSURES: with kThere the status was 200 and the body had at most max bytes, all of which are
  /// in the sink; with kAbsent the status was 404.
  [[nodiscard]] Presence get(const std::string& address, std::uint64_t max, BodySink& sink) const;
  /// Likewise, but status 403 is no error: stores whose folders nobody may list answer so where
  /// there is no such file.
  [[nodiscard]] Presence probe(const std::string& address, std::uint64_t max, BodySink& sink) const;
  /// Returns the way out that an error names where the server refuses an address.
  [[nodiscard]] static std::string way_past_refusal(const std::string& address);

  /// Fetches bytes from offset on: as many as out has, or those up to the end of the file.  From a
  /// server that does not know parts it takes the file up to there, if that is at most 64 MiB;
  /// where the server does not say how large the file is, it takes all of it, if that is as small.
  /// ENSURES: empty when there is no such file.
  [[nodiscard]] std::optional<RemotePart> get_part(const std::string& address, std::uint64_t offset,
                                                   std::span<std::byte> out) const;

 private:
  class Connections;
  struct Exchange;
  struct Verdict;

  [[nodiscard]] Verdict attempt(Exchange& exchange) const;
  void run(Exchange& exchange) const;
  [[nodiscard]] Presence whole(Exchange& exchange) const;

  HttpLimits limits_;
  std::string authorization_;  ///< a whole header; empty if there is none
  std::unique_ptr<Connections> connections_;
};

}  // namespace mw::io
