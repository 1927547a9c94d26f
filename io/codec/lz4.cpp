// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks LZ4 in two framings by liblz4.
#include "io/codec/lz4.h"
#include "io/codec/unpackers.h"

#include <lz4.h>

#include <algorithm>
#include <cstring>

#include "io/codec/checksums.h"
#include "io/codec/damage.h"
#include "io/file/byte_order.h"

namespace mw::io {
namespace {

/// What a packed byte unpacks to at most.
constexpr std::size_t kMaxRatio = 255;

std::size_t size_at(std::span<const std::byte> bytes, std::size_t at) {
  return load<std::uint32_t>(bytes.data() + at, ByteOrder::kLittle);
}

// A block of lz4-java: magic, token (method in the upper half), sizes and checksum, then its bytes.
constexpr std::string_view kMagic = "LZ4Block";
constexpr std::size_t kTokenAt = 8, kPackedSizeAt = 9, kSizeAt = 13, kChecksumAt = 17;
constexpr std::size_t kHeaderBytes = 21;
constexpr std::byte kMethodBits{0xf0}, kStored{0x10}, kPacked{0x20};
constexpr std::uint32_t kSeed = 0x9747b28c;
constexpr std::uint32_t kChecksumBits = 0x0fffffff;  // its Checksum drops the upper four

struct JavaBlock {
  std::span<const std::byte> bytes;
  std::size_t size = 0;
  std::uint32_t checksum = 0;
  bool is_stored = false;
};

JavaBlock next_block(std::span<const std::byte> packed, const PackedName& name) {
  if (packed.size() < kHeaderBytes) fail_packed(name, "truncated: no whole block header");
  if (std::memcmp(packed.data(), kMagic.data(), kMagic.size()) != 0) {
    fail_packed(name, "damaged: a block does not begin with \"LZ4Block\"");
  }
  const std::byte method = packed[kTokenAt] & kMethodBits;
  if (method != kStored && method != kPacked) fail_packed(name, "damaged: unknown block method");
  const std::size_t length = size_at(packed, kPackedSizeAt);
  if (length > packed.size() - kHeaderBytes) fail_packed(name, "truncated inside a block");
  return {.bytes = packed.subspan(kHeaderBytes, length),
          .size = size_at(packed, kSizeAt),
          .checksum = load<std::uint32_t>(packed.data() + kChecksumAt, ByteOrder::kLittle),
          .is_stored = method == kStored};
}

void append_java_block(std::vector<std::byte>& out, const JavaBlock& block,
                       const PackedName& name) {
  const std::size_t first = out.size();
  if (!block.is_stored) {
    append_lz4_block(out, block.bytes, block.size, name);
  } else if (block.bytes.size() == block.size) {
    out.insert(out.end(), block.bytes.begin(), block.bytes.end());
  } else {
    fail_packed(name, "damaged: a stored block has two sizes");
  }
  const std::uint32_t sum = xxhash32(std::span(out).subspan(first), kSeed) & kChecksumBits;
  if (sum != block.checksum) fail_packed(name, "damaged: the checksum of a block is wrong");
}

}  // namespace

void append_lz4_block(std::vector<std::byte>& out, std::span<const std::byte> block,
                      std::size_t size, const PackedName& name) {
  if (size / kMaxRatio > block.size() || size > LZ4_MAX_INPUT_SIZE ||
      block.size() > LZ4_MAX_INPUT_SIZE) {
    fail_packed(name, "damaged or truncated: it is too short for the size that it claims");
  }
  const std::size_t first = out.size();
  out.resize(first + size);
  const int count = LZ4_decompress_safe(reinterpret_cast<const char*>(block.data()),
                                        reinterpret_cast<char*>(out.data()) + first,
                                        static_cast<int>(block.size()), static_cast<int>(size));
  if (count < 0 || static_cast<std::size_t>(count) != size) {
    fail_packed(name, "damaged or truncated");
  }
}

std::vector<std::byte> unpack_lz4(std::span<const std::byte> packed, std::size_t max,
                                  std::string_view name) {
  const PackedName named{"lz4", name};
  if (packed.size() < 4) fail_packed(named, "truncated: no whole header");
  const std::size_t size = size_at(packed, 0);
  if (size > max) fail_too_much(named, max);
  std::vector<std::byte> out;
  append_lz4_block(out, packed.subspan(4), size, named);
  return out;
}

std::vector<std::byte> unpack_lz4_java(std::span<const std::byte> packed, std::size_t max,
                                       std::string_view name) {
  const PackedName named{"lz4", name};
  std::vector<std::byte> out;
  while (true) {
    const JavaBlock block = next_block(packed, named);
    packed = packed.subspan(kHeaderBytes + block.bytes.size());
    if (block.size == 0) break;  // an empty block is the end mark
    if (block.size > max - out.size()) fail_too_much(named, max);
    append_java_block(out, block, named);
  }
  if (!packed.empty()) fail_packed(named, "damaged: bytes follow its end");
  return out;
}

}  // namespace mw::io
