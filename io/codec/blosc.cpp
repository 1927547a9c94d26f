// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks Blosc.
#include <blosc.h>

#include <cstdint>
#include <new>

#include "io/codec/codec.h"
#include "io/codec/stream.h"
#include "io/file/byte_order.h"

namespace mw::io {
namespace {

/// Blosc's header has its version, that of the codec, flags, the bytes of an element, and three
/// sizes of 32 bits: unpacked, of a block, packed.
constexpr std::size_t kBlockSizeAt = 8;

}  // namespace

std::optional<std::uint64_t> blosc_block(std::span<const std::byte> packed) {
  if (packed.size() < BLOSC_MIN_HEADER_LENGTH) return std::nullopt;
  return load<std::uint32_t>(packed.data() + kBlockSizeAt, ByteOrder::kLittle);
}

std::vector<std::byte> unpack_blosc(std::span<const std::byte> packed, std::size_t max,
                                    std::string_view name) {
  const PackedName named{"blosc", name};
  if (packed.size() < BLOSC_MIN_HEADER_LENGTH) fail_packed(named, "truncated: no whole header");
  std::size_t size = 0;
  if (blosc_cbuffer_validate(packed.data(), packed.size(), &size) < 0) {
    fail_packed(named, "damaged or truncated: the sizes in its header are wrong");
  }
  if (size > max) fail_too_much(named, max);
  // The library takes memory for its blocks before it looks at anything else.
  const auto block = load<std::uint32_t>(packed.data() + kBlockSizeAt, ByteOrder::kLittle);
  if (size > 0 && (block == 0 || block > size)) {
    fail_packed(named, "damaged: the block size in its header is wrong");
  }
  std::vector<std::byte> out(size);
  const int count = blosc_decompress_ctx(packed.data(), out.data(), size, /*threads=*/1);
  if (count < 0 || static_cast<std::size_t>(count) != size) {
    fail_packed(named, "damaged, or packed by a codec that Blosc was built without");
  }
  return out;
}

std::vector<std::byte> pack_rows(std::span<const std::byte> rows, std::size_t row_bytes) {
  constexpr int kLevel = 1, kOneThread = 1;
  std::vector<std::byte> out(rows.size() + BLOSC_MAX_OVERHEAD);
  const int size =
      blosc_compress_ctx(kLevel, BLOSC_SHUFFLE, row_bytes, rows.size(), rows.data(), out.data(),
                         out.size(), BLOSC_LZ4_COMPNAME, /*blocksize=*/0, kOneThread);
  // There is room for bytes that do not shrink, and Debian's Blosc has LZ4, so only memory can be
  // missing.
  if (size <= 0) throw std::bad_alloc();
  out.resize(static_cast<std::size_t>(size));
  return out;
}

}  // namespace mw::io
