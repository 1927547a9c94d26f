// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// SHA-256 of a stream of bytes and 64-bit words.
#pragma once

#include <openssl/sha.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mw::io {

/// Takes contents piece by piece; the hash does not depend on where pieces end.
/// Cost: about 1 ns a byte where the processor has instructions for it.
class Hasher {
 public:
  Hasher();
  void add(std::span<const std::byte> bytes);
  void add(std::string_view characters) { add(std::as_bytes(std::span(characters))); }
  /// Adds a number as 8 bytes, least significant first.
  void add(std::uint64_t word);
  /// REQUIRES: nothing is added afterwards.
  [[nodiscard]] std::array<std::byte, SHA256_DIGEST_LENGTH> finish_bytes();
  /// Returns 64 hexadecimal digits.  REQUIRES: nothing is added afterwards.
  [[nodiscard]] std::string finish();

 private:
  void flush();

  SHA256_CTX context_{};
  std::vector<std::byte> buffer_;
};

}  // namespace mw::io
