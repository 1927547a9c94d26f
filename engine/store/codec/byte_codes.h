// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers of few bytes, which blocks and the journal are written with, and what encoder and decoder
// of blocks share; block_codec.h describes the layout.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/file/byte_order.h"

namespace mw::engine {

/// Most bytes of a varint: 7 bits a byte, low ones first, the high bit says that more follow.
inline constexpr std::size_t kMaxVarintBytes = 10;

/// Maps small numbers of either sign to small numbers: 0, -1, 1, -2 become 0, 1, 2, 3.
[[nodiscard]] inline std::uint64_t zigzag(std::int64_t value) {
  return static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
}
[[nodiscard]] inline std::int64_t unzigzag(std::uint64_t code) {
  return static_cast<std::int64_t>(code >> 1 ^ (0 - (code & 1)));
}

/// Appends to a buffer that grows.
class ByteWriter {
 public:
  void varint(std::uint64_t value) {
    room(kMaxVarintBytes);
    if (value < 0x80) {
      bytes_[size_++] = static_cast<std::byte>(value);
      return;
    }
    for (; value >= 0x80; value >>= 7) bytes_[size_++] = static_cast<std::byte>(value | 0x80);
    bytes_[size_++] = static_cast<std::byte>(value);
  }
  /// Appends the low `count` bytes of value, least significant first.  REQUIRES: count <= 8.
  void low_bytes(std::uint64_t value, std::size_t count) {
    room(sizeof value);
    io::store_little(value, bytes_.data() + size_);
    size_ += count;
  }
  void append(std::span<const std::byte> bytes) {
    room(bytes.size());
    std::copy(bytes.begin(), bytes.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += bytes.size();
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Returns what was written, which can be changed in place.
  [[nodiscard]] std::span<std::byte> written() { return std::span(bytes_).first(size_); }

 private:
  void room(std::size_t more) {
    if (bytes_.size() < size_ + more) bytes_.resize(2 * (size_ + more));
  }

  std::vector<std::byte> bytes_;
  std::size_t size_ = 0;
};

/// Thrown by ByteReader; a caller that knows what the bytes are turns it into an mw::Error.
struct BadBytes {
  const char* reason;
};

/// Reads what ByteWriter wrote.  REQUIRES: no number asked of low_bytes() has more than 8 bytes.
/// ERRORS: BadBytes at the end and for a varint beyond 64 bits.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes)
      : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  [[nodiscard]] std::uint64_t varint() {
    auto value = static_cast<std::uint64_t>(next());
    if (value < 0x80) return value;
    value &= 0x7f;
    for (unsigned shift = 7;; shift += 7) {
      const auto byte = static_cast<std::uint64_t>(next());
      if (shift == 63 && byte > 1) throw BadBytes{"a number has more than 64 bits"};
      value |= (byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
  }
  [[nodiscard]] std::uint64_t low_bytes(std::size_t count) {
    if (count > left()) throw BadBytes{"it ends too early"};
    std::uint64_t value = 0;
    if (left() >= sizeof value) {
      value = io::load<std::uint64_t>(at_, io::ByteOrder::kLittle);
      if (count < sizeof value) value &= (std::uint64_t{1} << 8 * count) - 1;
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        value |= static_cast<std::uint64_t>(at_[i]) << 8 * i;
      }
    }
    at_ += count;
    return value;
  }
  /// Reads the next bytes as they are.
  [[nodiscard]] std::span<const std::byte> bytes(std::size_t count) {
    if (count > left()) throw BadBytes{"it ends too early"};
    const std::span<const std::byte> out(at_, count);
    at_ += count;
    return out;
  }
  /// Reads a number of things that take at least one byte each; a number of more things than bytes
  /// are left is refused, so that nobody makes room for them.
  [[nodiscard]] std::size_t count() {
    const std::uint64_t value = varint();
    if (value > left()) throw BadBytes{"it is too short for what it says it holds"};
    return static_cast<std::size_t>(value);
  }
  /// Reads a varint below limit.
  [[nodiscard]] std::uint64_t below(std::uint64_t limit) {
    const std::uint64_t value = varint();
    if (value >= limit) throw BadBytes{"a number is out of range"};
    return value;
  }
  /// Goes past some varints.
  void pass(std::uint64_t varints) {
    while (varints > 0) {
      if (next() < std::byte{0x80}) --varints;
    }
  }
  [[nodiscard]] bool at_end() const { return at_ == end_; }
  /// Returns what was not read yet.
  [[nodiscard]] std::span<const std::byte> rest() const { return {at_, end_}; }

 private:
  std::byte next() {
    if (at_ == end_) throw BadBytes{"it ends too early"};
    return *at_++;
  }
  [[nodiscard]] std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  const std::byte* at_;
  const std::byte* end_;
};

inline constexpr std::uint64_t kBlockMagic = 0x0242574DU;  ///< "MWB", version 2
inline constexpr std::size_t kBlockHeadBytes = 16;
inline constexpr std::size_t kBlockSumAt = 4;
inline constexpr std::size_t kBlockSizeAt = 8;  ///< here the checksummed part begins
inline constexpr std::uint64_t kSameAsFirst = 9;
inline constexpr unsigned kDoubleBytes = 8;

/// The ten doubles of a quadric (a, b, c) bit by bit.
using QuadricBits = std::array<std::uint64_t, 10>;

}  // namespace mw::engine
