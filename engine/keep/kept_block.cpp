// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Only the list of labels at the front changes: tets and samples name places in this list, and its
// order is the same, since ranks ascend as labels do.
#include "engine/keep/kept_block.h"

#include <utility>

#include "engine/store/codec/byte_codes.h"
#include "engine/store/journal/work_file.h"
#include "io/codec/checksums.h"

namespace mw::engine {
namespace {

std::vector<std::byte> joined(ByteWriter& head, std::span<const std::byte> rest) {
  const std::span<std::byte> first = head.written();
  std::vector<std::byte> out;
  out.reserve(first.size() + rest.size());
  out.insert(out.end(), first.begin(), first.end());
  out.insert(out.end(), rest.begin(), rest.end());
  return out;
}

Label label_of(std::uint64_t key, const LabelKeys& labels) {
  const Label label = labels.label(key);
  if (label == kExterior) throw BadBytes{"it has a label that the volume does not have"};
  return label;
}

}  // namespace

std::vector<std::byte> to_kept(std::span<const std::byte> encoded, const LabelKeys& labels) {
  ByteReader in(encoded.subspan(kBlockHeadBytes));
  for (int i = 0; i < 4; ++i) static_cast<void>(in.varint());
  ByteWriter out;
  const std::size_t count = in.count();
  out.varint(count);
  std::uint64_t before = 0, label = 0;
  for (std::size_t i = 0; i < count; ++i) {
    label += in.varint();
    const std::uint64_t key = labels.key(static_cast<Label>(label));
    out.varint(key - std::exchange(before, key));
  }
  return joined(out, in.rest());
}

std::vector<std::byte> from_kept(const BlockKey& key, std::span<const std::byte> kept,
                                 const LabelKeys& labels) {
  try {
    ByteReader in(kept);
    ByteWriter out;
    out.low_bytes(kBlockMagic, 4);
    out.low_bytes(0, 4);
    out.low_bytes(0, 8);
    out.varint(key.march);
    out.varint(static_cast<std::uint64_t>(key.block.x));
    out.varint(static_cast<std::uint64_t>(key.block.y));
    out.varint(static_cast<std::uint64_t>(key.block.z));
    const std::size_t count = in.count();
    out.varint(count);
    std::uint64_t label_key = 0;
    Label before = 0;
    for (std::size_t i = 0; i < count; ++i) {
      label_key += in.varint();
      const Label label = label_of(label_key, labels);
      out.varint(label - std::exchange(before, label));
    }
    std::vector<std::byte> bytes = joined(out, in.rest());
    io::store_little<std::uint64_t>(bytes.size(), bytes.data() + kBlockSizeAt);
    io::store_little<std::uint32_t>(io::checksum(std::span(bytes).subspan(kBlockSizeAt)),
                                    bytes.data() + kBlockSumAt);
    return bytes;
  } catch (const BadBytes& bad) {
    throw DamagedWork(name(key), bad.reason);
  }
}

}  // namespace mw::engine
