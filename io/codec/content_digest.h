// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names for contents: equal digests are taken for equal bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "io/codec/hasher.h"

namespace mw::io {

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
