// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/codec/content_digest.h"

#include <array>

#include "io/file/byte_order.h"

namespace mw::io {

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
