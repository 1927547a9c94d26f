// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Random access to bytes: the interface between the formats and the file system; and bytes from the
// first to the last.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mw::io {

/// Returns the sum of two numbers of a file, or the largest number when it is larger.
[[nodiscard]] inline std::uint64_t saturating_sum(std::uint64_t a, std::uint64_t b) {
  return a + std::min(b, ~a);
}

/// Returns the product of two numbers of a file, or the largest number when it is larger.
[[nodiscard]] inline std::uint64_t saturating_product(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  return b != 0 && a > kMax / b ? kMax : a * b;
}

/// A readable run of bytes.  Thread safety: all members may be called from many threads.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// Returns the size, or max if that is less: a packed source unpacks no more than max bytes.
  [[nodiscard]] virtual std::uint64_t size_within(std::uint64_t max) const {
    return std::min(size(), max);
  }
  /// Returns the name for error messages, which is the path for a file.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Fills out with the bytes from offset on.
  /// ERRORS: mw::Error(kInput) with name, offset and length when there are fewer, or on I/O errors.
  virtual void read_at(std::uint64_t offset, std::span<std::byte> out) const = 0;
};

/// A part of the bytes of a source that others may own too, under a name of its own.
class BytesPart : public ByteSource {
 public:
  /// REQUIRES: offset + size within the source.
  BytesPart(std::shared_ptr<const ByteSource> source, std::uint64_t offset, std::uint64_t size,
            std::string name)
      : source_(std::move(source)), offset_(offset), size_(size), name_(std::move(name)) {}

  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] const std::string& name() const override { return name_; }
  void read_at(std::uint64_t offset, std::span<std::byte> out) const override {
    source_->read_at(offset_ + offset, out);
  }

 private:
  std::shared_ptr<const ByteSource> source_;
  std::uint64_t offset_;
  std::uint64_t size_;
  std::string name_;
};

/// Returns the first `length` bytes, or all when there are fewer.
[[nodiscard]] std::vector<std::byte> read_prefix(const ByteSource& source, std::size_t length);

/// Returns all bytes as text; nothing when they are more than `max`.
[[nodiscard]] std::optional<std::string> read_whole(const ByteSource& source, std::uint64_t max);

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
