// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// SHA-256 by OpenSSL.
#include "io/mesh/hasher.h"

#include <array>

#include "io/file/byte_order.h"
#include "kernels/core/error.h"

namespace mw::io {
namespace {

constexpr std::size_t kBufferBytes = 1 << 16;

void check(bool done) {
  if (!done) throw Error(ErrorKind::kInternal, "SHA-256 is not available in this OpenSSL");
}

}  // namespace

Hasher::Hasher() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
  check(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
}

void Hasher::add(std::string_view characters) {
  flush();
  check(EVP_DigestUpdate(context_.get(), characters.data(), characters.size()) == 1);
}

void Hasher::add(std::uint64_t word) {
  buffer_.resize(buffer_.size() + sizeof word);
  store_little(word, buffer_.data() + buffer_.size() - sizeof word);
  if (buffer_.size() >= kBufferBytes) flush();
}

std::string Hasher::finish() {
  flush();
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned length = 0;
  check(EVP_DigestFinal_ex(context_.get(), bytes.data(), &length) == 1);
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string hex;
  for (unsigned i = 0; i < length; ++i) {
    hex.push_back(kDigits[bytes[i] >> 4]);
    hex.push_back(kDigits[bytes[i] & 15]);
  }
  return hex;
}

void Hasher::flush() {
  check(EVP_DigestUpdate(context_.get(), buffer_.data(), buffer_.size()) == 1);
  buffer_.clear();
}

}  // namespace mw::io
