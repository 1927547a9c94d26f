// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// SHA-256 of a stream of 64-bit words.
#pragma once

#include <openssl/sha.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mw::io {

class Hasher {
 public:
  Hasher();
  void add(std::string_view characters);
  /// Adds a number as 8 bytes, least significant first.
  void add(std::uint64_t word);
  /// 64 hexadecimal digits.  REQUIRES: nothing is added afterwards.
  [[nodiscard]] std::string finish();

 private:
  void flush();

  SHA256_CTX context_{};
  std::vector<std::byte> buffer_;
};

}  // namespace mw::io
