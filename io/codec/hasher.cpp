// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// SHA-256 by OpenSSL's low-level functions, since its others (EVP) allocate, and crash where an
// allocation fails.
#define OPENSSL_SUPPRESS_DEPRECATED
#include "io/codec/hasher.h"

#include "io/file/byte_order.h"

namespace mw::io {
namespace {

constexpr std::size_t kBufferBytes = 1 << 16;

}  // namespace

Hasher::Hasher() {
  SHA256_Init(&context_);
}

void Hasher::add(std::span<const std::byte> bytes) {
  flush();
  SHA256_Update(&context_, bytes.data(), bytes.size());
}

void Hasher::add(std::uint64_t word) {
  buffer_.resize(buffer_.size() + sizeof word);
  store_little(word, buffer_.data() + buffer_.size() - sizeof word);
  if (buffer_.size() >= kBufferBytes) flush();
}

std::array<std::byte, SHA256_DIGEST_LENGTH> Hasher::finish_bytes() {
  flush();
  std::array<std::byte, SHA256_DIGEST_LENGTH> bytes{};
  SHA256_Final(reinterpret_cast<unsigned char*>(bytes.data()), &context_);
  return bytes;
}

std::string Hasher::finish() {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string hex;
  for (const std::byte byte : finish_bytes()) {
    hex.push_back(kDigits[std::to_integer<unsigned>(byte) >> 4]);
    hex.push_back(kDigits[std::to_integer<unsigned>(byte) & 15]);
  }
  return hex;
}

void Hasher::flush() {
  SHA256_Update(&context_, buffer_.data(), buffer_.size());
  buffer_.clear();
}

ContentDigest DigestMaker::finish() {
  const std::array<std::byte, SHA256_DIGEST_LENGTH> bytes = hasher_.finish_bytes();
  return {load<std::uint64_t>(bytes.data(), ByteOrder::kLittle),
          load<std::uint64_t>(bytes.data() + sizeof(std::uint64_t), ByteOrder::kLittle)};
}

ContentDigest content_digest(std::span<const std::byte> bytes) {
  DigestMaker maker;
  maker.add(bytes);
  return maker.finish();
}

}  // namespace mw::io
