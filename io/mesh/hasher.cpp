// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// SHA-256 by OpenSSL: its low-level functions, since the others (EVP) allocate, and crash where an
// allocation fails.
#define OPENSSL_SUPPRESS_DEPRECATED
#include "io/mesh/hasher.h"

#include <array>

#include "io/file/byte_order.h"

namespace mw::io {
namespace {

constexpr std::size_t kBufferBytes = 1 << 16;

}  // namespace

Hasher::Hasher() {
  SHA256_Init(&context_);
}

void Hasher::add(std::string_view characters) {
  flush();
  SHA256_Update(&context_, characters.data(), characters.size());
}

void Hasher::add(std::uint64_t word) {
  buffer_.resize(buffer_.size() + sizeof word);
  store_little(word, buffer_.data() + buffer_.size() - sizeof word);
  if (buffer_.size() >= kBufferBytes) flush();
}

std::string Hasher::finish() {
  flush();
  std::array<unsigned char, SHA256_DIGEST_LENGTH> bytes{};
  SHA256_Final(bytes.data(), &context_);
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string hex;
  for (const unsigned char byte : bytes) {
    hex.push_back(kDigits[byte >> 4]);
    hex.push_back(kDigits[byte & 15]);
  }
  return hex;
}

void Hasher::flush() {
  SHA256_Update(&context_, buffer_.data(), buffer_.size());
  buffer_.clear();
}

}  // namespace mw::io
