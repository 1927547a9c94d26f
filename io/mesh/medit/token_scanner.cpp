// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Words and numbers of an ASCII file, read through a bounded buffer.
#include "io/mesh/medit/token_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/file/errors.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kBufferBytes = 1 << 20;
/// No number or keyword is that long; keeps memory bounded on binary files.
constexpr std::size_t kMaxWordBytes = 256;
constexpr std::size_t kMaxCommentBytes = 1 << 13;

bool is_blank(int c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

std::string_view without_plus(std::string_view word) {
  return word.starts_with('+') ? word.substr(1) : word;
}

template <class T>
bool parse_all(std::string_view word, T& number) {
  const auto [stop, verdict] = std::from_chars(word.data(), word.data() + word.size(), number);
  return verdict == std::errc{} && stop == word.data() + word.size();
}

}  // namespace

bool TokenScanner::refill() {
  const std::uint64_t count = source_.size_within(offset_ + kBufferBytes) - offset_;
  buffer_.resize(count);
  source_.read_at(offset_, std::as_writable_bytes(std::span(buffer_)));
  offset_ += count;
  at_ = 0;
  return count > 0;
}

void TokenScanner::skip_blanks() {
  for (int c = peek(); c >= 0 && (is_blank(c) || c == '#'); c = peek()) {
    if (c == '#') {
      skip_comment();
      continue;
    }
    if (c == '\n') ++line_;
    ++at_;
  }
}

/// Leaves the line end.
void TokenScanner::skip_comment() {
  std::string comment;
  ++at_;
  for (int c = peek(); c >= 0 && c != '\n'; c = peek()) {
    if (comment.size() < kMaxCommentBytes) comment.push_back(static_cast<char>(c));
    ++at_;
  }
  if (take_comment_) take_comment_(comment);
}

std::string_view TokenScanner::next() {
  skip_blanks();
  word_.clear();
  for (int c = peek(); c >= 0 && !is_blank(c) && c != '#'; c = peek()) {
    if (word_.size() == kMaxWordBytes) fail("not an ASCII mesh file");
    word_.push_back(static_cast<char>(c));
    ++at_;
  }
  return word_;
}

double TokenScanner::next_real(std::string_view expected) {
  const std::string_view word = next();
  double number = 0;
  if (!parse_all(without_plus(word), number) || !std::isfinite(number)) fail_word(expected, word);
  return number;
}

std::uint64_t TokenScanner::next_count(std::string_view expected) {
  bool negative = false;
  const std::uint64_t number = next_integer(expected, negative);
  if (negative) fail_word(expected, word_);
  return number;
}

std::uint64_t TokenScanner::next_integer(std::string_view expected, bool& negative) {
  const std::string_view word = next();
  negative = word.starts_with('-');
  std::int64_t below = 0;
  std::uint64_t above = 0;
  if (!(negative ? parse_all(word, below) : parse_all(without_plus(word), above))) {
    fail_word(expected, word);
  }
  return negative ? static_cast<std::uint64_t>(below) : above;
}

void TokenScanner::fail_word(std::string_view expected, std::string_view word) const {
  if (word.empty()) fail(text("truncated: the file ends where ", expected, " is expected"));
  fail(text("'", word, "' stands where ", expected, " is expected"));
}

void TokenScanner::fail(std::string_view reason) const {
  fail_input(source_.name(), text("line ", line_), reason, "write the mesh anew");
}

}  // namespace mw::io
