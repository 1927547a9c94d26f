// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Records of visits as bytes, and the order in which what they tell is given up.
#include "engine/keep/window_records.h"

#include <algorithm>
#include <tuple>

#include "engine/store/run_layout.h"

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

namespace {

Box3 box_of(const RunLayout& layout, std::uint64_t window) {
  const WindowKey key = layout.window_key(window);
  return layout.grid(key.march).window_box(key.window);
}

/// Returns the largest gap between two boxes along an axis; 0 where they touch.
std::int64_t distance(const Box3& a, const Box3& b) {
  const auto gap = [](std::int64_t a_lo, std::int64_t a_hi, std::int64_t b_lo, std::int64_t b_hi) {
    return std::max({std::int64_t{0}, a_lo - b_hi, b_lo - a_hi});
  };
  return std::max({gap(a.lo.x, a.hi.x, b.lo.x, b.hi.x), gap(a.lo.y, a.hi.y, b.lo.y, b.hi.y),
                   gap(a.lo.z, a.hi.z, b.lo.z, b.hi.z)});
}

}  // namespace

bool leaves_final_block(const RunLayout& layout, const WindowKey& key) {
  if (key.march + 1 < layout.marches()) return false;
  const BlockRoute route(layout);
  const auto blocks = layout.grid(key.march).blocks_of(key.window);
  return std::any_of(blocks.begin(), blocks.end(), [&](Index3 block) {
    return !route.next_user({{key.march, block}, key});
  });
}

std::vector<KeptBytes> drop_order(const RunLayout& layout, std::vector<KeptBytes> kept,
                                  std::uint32_t last_run) {
  Box3 visited;
  for (const KeptBytes& k : kept) {
    if (k.run == last_run) visited = hull(visited, box_of(layout, k.window));
  }
  std::erase_if(kept, [&](const KeptBytes& k) {
    return leaves_final_block(layout, layout.window_key(k.window));
  });
  const auto turn = [&](const KeptBytes& k) {
    return std::tuple(k.run, -distance(box_of(layout, k.window), visited), ~k.window);
  };
  std::sort(kept.begin(), kept.end(),
            [&](const KeptBytes& a, const KeptBytes& b) { return turn(a) < turn(b); });
  return kept;
}

}  // namespace mw::engine
