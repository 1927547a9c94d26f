// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bytes from the first to the last, through a bounded buffer.
#pragma once

#include <string>
#include <vector>

#include "io/file/source/byte_source.h"

namespace mw::io {

/// Whether a character, or the -1 at an end, is a space, a tab or any end of a line or page.
[[nodiscard]] inline bool is_blank(int c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Reads characters, lines and binary numbers by turns.  Memory: 1 MiB.
/// ERRORS: those of the source.
class ByteCursor {
 public:
  /// REQUIRES: source outlives this.
  explicit ByteCursor(const ByteSource& source) : source_(source) {}

  [[nodiscard]] const ByteSource& source() const { return source_; }
  /// Returns the next character without taking it, or -1 at the end.
  [[nodiscard]] int peek() { return at_ < buffer_.size() || refill() ? buffer_[at_] : -1; }
  /// REQUIRES: peek() >= 0.
  void take() {
    if (buffer_[at_++] == '\n') ++line_;
  }
  /// Fills out; returns false and takes nothing when fewer bytes are left.
  [[nodiscard]] bool read(std::span<std::byte> out);
  /// Reads a line into `out`, without its end and a '\r' in front of that.  It reads at most `max`
  /// characters and leaves the rest to the next call.  False at the end of the source.
  [[nodiscard]] bool read_line(std::string& out, std::size_t max);

  [[nodiscard]] std::uint64_t offset() const { return loaded_ - buffer_.size() + at_; }
  /// Returns how many bytes follow, counted up to `max`.
  [[nodiscard]] std::uint64_t left(std::uint64_t max) const;
  /// The number of the line, counted from 1 by the line ends that take() and read_line() saw.
  [[nodiscard]] std::uint64_t line() const { return line_; }

 private:
  bool refill();

  const ByteSource& source_;
  std::vector<unsigned char> buffer_;
  std::size_t at_ = 0;
  std::uint64_t loaded_ = 0;  ///< where the buffer ends in the source
  std::uint64_t line_ = 1;
};

}  // namespace mw::io
