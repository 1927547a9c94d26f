// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// SHA-256 by OpenSSL's low-level functions, which do not allocate (io/mesh/hasher.cpp).
#define OPENSSL_SUPPRESS_DEPRECATED
#include "io/codec/content_digest.h"

#include <array>

#include "io/file/byte_order.h"

namespace mw::io {

DigestMaker::DigestMaker() {
  SHA256_Init(&context_);
}

void DigestMaker::add(std::span<const std::byte> bytes) {
  SHA256_Update(&context_, bytes.data(), bytes.size());
}

void DigestMaker::add(std::uint64_t word) {
  std::array<std::byte, sizeof word> bytes{};
  store_little(word, bytes.data());
  add(bytes);
}

ContentDigest DigestMaker::finish() {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> bytes{};
  SHA256_Final(bytes.data(), &context_);
  const auto word = [&](std::size_t at) {
    return load<std::uint64_t>(std::as_bytes(std::span(bytes)).data() + at, ByteOrder::kLittle);
  };
  return {word(0), word(8)};
}

ContentDigest content_digest(std::span<const std::byte> bytes) {
  DigestMaker maker;
  maker.add(bytes);
  return maker.finish();
}

}  // namespace mw::io
