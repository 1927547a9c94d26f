// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// SHA-256 of a stream of bytes and 64-bit words, and names for contents: equal digests are taken
// for equal bytes.
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

/// The first 128 bits of a SHA-256; all zeros stand for no digest.
struct ContentDigest {
  std::uint64_t first = 0;
  std::uint64_t second = 0;

  friend bool operator==(const ContentDigest&, const ContentDigest&) = default;
  [[nodiscard]] bool is_none() const { return first == 0 && second == 0; }
};

/// A Hasher that takes and makes these digests.
class DigestMaker {
 public:
  void add(std::span<const std::byte> bytes) { hasher_.add(bytes); }
  void add(std::string_view text) { hasher_.add(text); }
  void add(std::uint64_t word) { hasher_.add(word); }
  void add(const ContentDigest& digest) {
    add(digest.first);
    add(digest.second);
  }
  /// REQUIRES: nothing is added afterwards.
  [[nodiscard]] ContentDigest finish();

 private:
  Hasher hasher_;
};

[[nodiscard]] ContentDigest content_digest(std::span<const std::byte> bytes);

}  // namespace mw::io
