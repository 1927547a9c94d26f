// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bytes of a file format, put together from numbers and text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mw::io {

/// Grows at its end.
class LittleBytes {
 public:
  /// The low `bytes` bytes of value, least significant first.
  LittleBytes& number(std::uint64_t value, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i) bytes_ += static_cast<char>(value >> 8 * i & 0xffU);
    return *this;
  }
  LittleBytes& text(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  /// Zeros up to this size.
  LittleBytes& pad_to(std::size_t size) {
    if (size > bytes_.size()) bytes_.resize(size, '\0');
    return *this;
  }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace mw::io
