// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bytes one after the other, as they are or from base64 text, from which VTK arrays are read.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "io/file/source/byte_source.h"

namespace mw::io {

class ByteStream {
 public:
  virtual ~ByteStream() = default;
  /// ERRORS: mw::Error(kInput) when there are fewer bytes or the text is no base64.
  virtual void read(std::span<std::byte> out) = 0;
  /// Returns an upper bound on the bytes left, counted up to `max`, to refuse absurd lengths before
  /// memory is taken.
  [[nodiscard]] virtual std::uint64_t left(std::uint64_t max) const = 0;
};

class SourceStream : public ByteStream {
 public:
  SourceStream(const ByteSource& source, std::uint64_t offset) : source_(source), next_(offset) {}
  void read(std::span<std::byte> out) override {
    source_.read_at(next_, out);
    next_ += out.size();
  }
  [[nodiscard]] std::uint64_t left(std::uint64_t max) const override {
    const std::uint64_t size = source_.size_within(saturating_sum(next_, max));
    return next_ < size ? size - next_ : 0;
  }

 private:
  const ByteSource& source_;
  std::uint64_t next_;
};

/// Decodes groups of four characters.  A padded group may stand in the middle, as VTK encodes the
/// header of an array and its data apart.  Blanks are skipped.
class Base64Stream : public ByteStream {
 public:
  Base64Stream(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}
  void read(std::span<std::byte> out) override;
  [[nodiscard]] std::uint64_t left(std::uint64_t max) const override {
    return std::min<std::uint64_t>(ready_ + (text_.size() - at_), max);
  }

 private:
  void decode_group();

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  std::array<std::byte, 3> group_{};
  std::size_t ready_ = 0;  ///< bytes of group_ not yet given out
  std::size_t used_ = 0;   ///< bytes of group_ given out
};

}  // namespace mw::io
