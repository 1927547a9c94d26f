// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Random access to bytes: the interface between the formats and the file system.
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

}  // namespace mw::io
