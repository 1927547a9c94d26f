// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/keep/window_records.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kNumbers = std::uint64_t{1} << 32U;

void put(ByteWriter& out, const io::ContentDigest& digest) {
  out.low_bytes(digest.first, 8);
  out.low_bytes(digest.second, 8);
}

io::ContentDigest get_digest(ByteReader& in) {
  io::ContentDigest out;
  out.first = in.low_bytes(8);
  out.second = in.low_bytes(8);
  return out;
}

std::uint32_t get_number(ByteReader& in) {
  return static_cast<std::uint32_t>(in.below(kNumbers));
}

}  // namespace

ByteWriter encode(const WindowRecord& record) {
  ByteWriter out;
  out.varint(record.window);
  out.varint(record.run);
  out.varint(std::uint64_t{record.is_dropped});
  put(out, record.input.blocks);
  put(out, record.input.bricks);
  put(out, record.input.labels);
  out.varint(record.extent.offset);
  out.varint(record.extent.size);
  out.varint(record.blocks.size());
  for (const KeptBlock& block : record.blocks) {
    put(out, block.version.digest);
    for (const std::int32_t v : block.version.voxels) out.varint(zigzag(v));
    out.varint(block.memory_kib);
    out.varint(std::uint64_t{block.is_kept});
  }
  return out;
}

WindowRecord decode_window_record(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  WindowRecord out;
  out.window = in.varint();
  out.run = get_number(in);
  out.is_dropped = in.below(2) == 1;
  out.input.blocks = get_digest(in);
  out.input.bricks = get_digest(in);
  out.input.labels = get_digest(in);
  out.extent.offset = in.varint();
  out.extent.size = in.below(kNumbers);
  out.blocks.resize(in.count());
  for (KeptBlock& block : out.blocks) {
    block.version.digest = get_digest(in);
    for (std::int32_t& v : block.version.voxels) {
      v = static_cast<std::int32_t>(unzigzag(in.varint()));
    }
    block.memory_kib = get_number(in);
    block.is_kept = in.below(2) == 1;
  }
  if (!in.at_end()) throw BadBytes{"a record has a wrong length"};
  return out;
}

}  // namespace mw::engine
