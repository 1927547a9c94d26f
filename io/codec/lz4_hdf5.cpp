// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks LZ4 in the framing of HDF5's registered filter (32004).
#include "io/codec/unpackers.h"

#include <algorithm>
#include <cstdint>

#include "io/codec/damage.h"
#include "io/codec/lz4.h"
#include "io/file/byte_order.h"

namespace mw::io {
namespace {

constexpr std::size_t kHeaderBytes = 12;

void append_block(std::vector<std::byte>& out, std::span<const std::byte> block, std::size_t size,
                  const PackedName& name) {
  if (block.size() == size) {
    out.insert(out.end(), block.begin(), block.end());
    return;
  }
  append_lz4_block(out, block, size, name);
}

}  // namespace

std::vector<std::byte> unpack_lz4_hdf5(std::span<const std::byte> packed, std::size_t max,
                                       std::string_view name) {
  const PackedName named{"lz4", name};
  if (packed.size() < kHeaderBytes) fail_packed(named, "truncated: no whole header");
  const auto size = load<std::uint64_t>(packed.data(), ByteOrder::kBig);
  const auto block_size = load<std::uint32_t>(packed.data() + 8, ByteOrder::kBig);
  if (size > max) fail_too_much(named, max);
  if (size > 0 && block_size == 0) fail_packed(named, "damaged: its blocks are empty");
  packed = packed.subspan(kHeaderBytes);
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
