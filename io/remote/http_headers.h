// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the headers of an answer say (RFC 9110).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mw::io {

/// The header Content-Range, such as "bytes 0-15/1024".
struct ContentRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  std::uint64_t file_bytes = 0;
};

/// Returns what the header says; nothing where it says no part of a file of known size.
[[nodiscard]] std::optional<ContentRange> parse_content_range(std::string_view text);

/// The headers of an answer, which is the last one behind redirects.
struct HttpHeaders {
  long status = 0;
  std::string content_range;
  std::string content_encoding;
  std::string content_length;
  std::string transfer_encoding;
  bool has_frames = false;  ///< the protocol is HTTP/2 or later
  std::string etag;
  std::string last_modified;

  /// Takes a line of an answer; the first line of another answer makes it forget all before.
  void add(std::string_view line);
  /// Returns what changes with the content: the strong ETag, else the date.
  [[nodiscard]] std::string version() const;
  /// Whether a connection that breaks is told from the end of the body.
  [[nodiscard]] bool has_end() const;
  /// Whether the body is compressed on the way.
  [[nodiscard]] bool is_packed() const;
};

}  // namespace mw::io
