// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// SHA-256 of a stream of 64-bit words.
#pragma once

#include <openssl/evp.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace mw::io {

/// ERRORS of all: mw::Error(kInternal) when OpenSSL has no SHA-256.
class Hasher {
 public:
  Hasher();
  void add(std::string_view characters);
  /// As 8 bytes, least significant first.
  void add(std::uint64_t word);
  /// 64 hexadecimal digits.  REQUIRES: nothing is added afterwards.
  [[nodiscard]] std::string finish();

 private:
  void flush();

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
  std::vector<std::byte> buffer_;
};

}  // namespace mw::io
