// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Words and numbers of an ASCII file, read through a bounded buffer.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_source.h"

namespace mw::io {

/// Words are separated by blanks, tabs, line ends of any kind; '#' begins a comment up to the end
/// of its line.
class TokenScanner {
 public:
  explicit TokenScanner(const ByteSource& source) : source_(source) {}
  /// From now on each comment is passed on, without its '#' and line end, cut at 8 KiB.
  void on_comment(std::function<void(std::string_view)> take) { take_comment_ = std::move(take); }

  /// The next word, or empty at the end.  Valid until the next call.
  [[nodiscard]] std::string_view next();
  /// ERRORS of all: mw::Error(kInput) with file, line and what was expected.
  [[nodiscard]] double next_real(std::string_view expected);
  [[nodiscard]] std::uint64_t next_count(std::string_view expected);
  /// An integer in -2^63 .. 2^64-1, as two's complement; negative tells the sign.
  [[nodiscard]] std::uint64_t next_integer(std::string_view expected, bool& negative);
  [[noreturn]] void fail(std::string_view reason) const;

 private:
  /// The next character without taking it, or -1 at the end.
  [[nodiscard]] int peek() { return at_ < buffer_.size() || refill() ? buffer_[at_] : -1; }
  bool refill();
  void skip_blanks();
  void skip_comment();
  [[noreturn]] void fail_word(std::string_view expected, std::string_view word) const;

  const ByteSource& source_;
  std::uint64_t offset_ = 0;
  std::vector<unsigned char> buffer_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
  std::string word_;
  std::function<void(std::string_view)> take_comment_;
};

}  // namespace mw::io
