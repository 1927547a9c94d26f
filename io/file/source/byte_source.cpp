// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bytes from the first to the last, through a bounded buffer.
#include "io/file/source/byte_source.h"

#include <cstring>

namespace mw::io {
namespace {

constexpr std::uint64_t kBufferBytes = 1 << 20;

}  // namespace

bool ByteCursor::refill() {
  const std::uint64_t count = source_.size_within(loaded_ + kBufferBytes) - loaded_;
  buffer_.resize(count);
  source_.read_at(loaded_, std::as_writable_bytes(std::span(buffer_)));
  loaded_ += count;
  at_ = 0;
  return count > 0;
}

std::uint64_t ByteCursor::left(std::uint64_t max) const {
  return source_.size_within(saturating_sum(offset(), max)) - offset();
}

bool ByteCursor::read(std::span<std::byte> out) {
  if (out.size() > left(out.size())) return false;
  while (!out.empty()) {
    if (at_ == buffer_.size()) refill();
    const std::size_t count = std::min(out.size(), buffer_.size() - at_);
    std::memcpy(out.data(), buffer_.data() + at_, count);
    at_ += count;
    out = out.subspan(count);
  }
  return true;
}

bool ByteCursor::read_line(std::string& out, std::size_t max) {
  out.clear();
  if (peek() < 0) return false;
  bool is_whole = false;
  for (int c = peek(); c >= 0 && !is_whole && out.size() < max; c = peek()) {
    take();
    is_whole = c == '\n';
    if (!is_whole) out.push_back(static_cast<char>(c));
  }
  is_whole = is_whole || peek() < 0;
  if (is_whole && out.ends_with('\r')) out.pop_back();
  return true;
}

}  // namespace mw::io
