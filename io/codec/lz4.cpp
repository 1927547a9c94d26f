// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks LZ4 in its three framings: plain, of lz4-java, of HDF5.
#include <lz4.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "io/codec/checksums.h"
#include "io/codec/codec.h"
#include "io/codec/stream.h"
#include "io/file/byte_order.h"

namespace mw::io {
namespace {

/// The most bytes that a byte packed by LZ4 unpacks to.
constexpr std::size_t kMaxRatio = 255;

std::size_t size_at(std::span<const std::byte> bytes, std::size_t at) {
  return load<std::uint32_t>(bytes.data() + at, ByteOrder::kLittle);
}

// A block of lz4-java: magic, token (method in the upper half), sizes and checksum, then its bytes.
constexpr std::string_view kMagic = "LZ4Block";
constexpr std::size_t kTokenAt = 8, kPackedSizeAt = 9, kSizeAt = 13, kChecksumAt = 17;
constexpr std::size_t kJavaHeaderBytes = 21;
constexpr std::byte kMethodBits{0xf0}, kStored{0x10}, kPacked{0x20};
constexpr std::uint32_t kSeed = 0x9747b28c;
constexpr std::uint32_t kChecksumBits = 0x0fffffff;  // lz4-java drops the upper four

struct JavaBlock {
  std::span<const std::byte> bytes;
  std::size_t size = 0;
  std::uint32_t checksum = 0;
  bool is_stored = false;
};

JavaBlock next_block(std::span<const std::byte> packed, const PackedName& name) {
  if (packed.size() < kJavaHeaderBytes) fail_packed(name, "truncated: no whole block header");
  if (std::memcmp(packed.data(), kMagic.data(), kMagic.size()) != 0) {
    fail_packed(name, "damaged: a block does not begin with \"LZ4Block\"");
  }
  const std::byte method = packed[kTokenAt] & kMethodBits;
  if (method != kStored && method != kPacked) fail_packed(name, "damaged: unknown block method");
  const std::size_t length = size_at(packed, kPackedSizeAt);
  if (length > packed.size() - kJavaHeaderBytes) fail_packed(name, "truncated inside a block");
  return {.bytes = packed.subspan(kJavaHeaderBytes, length),
          .size = size_at(packed, kSizeAt),
          .checksum = load<std::uint32_t>(packed.data() + kChecksumAt, ByteOrder::kLittle),
          .is_stored = method == kStored};
}

/// Appends the `size` bytes of one bare block to out.  Allocates nothing for a size that the block
/// cannot have.  ERRORS: mw::Error(kInput) for damage and another size.
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

constexpr std::size_t kHdf5HeaderBytes = 12;

void append_block(std::vector<std::byte>& out, std::span<const std::byte> block, std::size_t size,
                  const PackedName& name) {
  if (block.size() == size) {
    out.insert(out.end(), block.begin(), block.end());
    return;
  }
  append_lz4_block(out, block, size, name);
}

}  // namespace

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
    packed = packed.subspan(kJavaHeaderBytes + block.bytes.size());
    if (block.size == 0) break;  // an empty block is the end mark
    if (block.size > max - out.size()) fail_too_much(named, max);
    append_java_block(out, block, named);
  }
  if (!packed.empty()) fail_packed(named, "damaged: bytes follow its end");
  return out;
}

std::vector<std::byte> unpack_lz4_hdf5(std::span<const std::byte> packed, std::size_t max,
                                       std::string_view name) {
  const PackedName named{"lz4", name};
  if (packed.size() < kHdf5HeaderBytes) fail_packed(named, "truncated: no whole header");
  const auto size = load<std::uint64_t>(packed.data(), ByteOrder::kBig);
  const auto block_size = load<std::uint32_t>(packed.data() + 8, ByteOrder::kBig);
  if (size > max) fail_too_much(named, max);
  if (size > 0 && block_size == 0) fail_packed(named, "damaged: its blocks are empty");
  packed = packed.subspan(kHdf5HeaderBytes);
  std::vector<std::byte> out;
  while (out.size() < size) {
    if (packed.size() < 4) fail_packed(named, "truncated between blocks");
    const auto length = load<std::uint32_t>(packed.data(), ByteOrder::kBig);
    packed = packed.subspan(4);
    if (length > packed.size()) fail_packed(named, "truncated inside a block");
    append_block(out, packed.first(length), std::min<std::size_t>(block_size, size - out.size()),
                 named);
    packed = packed.subspan(length);
  }
  return out;
}

}  // namespace mw::io
