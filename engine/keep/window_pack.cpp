// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Turns kept blocks into columns and back.
#include "engine/keep/window_pack.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "engine/store/codec/byte_codes.h"
#include "io/codec/checksums.h"

namespace mw::engine {
namespace {

/// Values of one kind.
enum Column : std::size_t {
  kCounts,     ///< lengths of lists, the labels, and the least positions
  kIds,        ///< ids of vertices
  kPositions,  ///< a column for each axis
  kQuadricCodes = kPositions + 3,
  kFirstBytes,  ///< the highest bytes of the quadrics' numbers, a column for each kind (kKindOf)
  kSecondBytes = kFirstBytes + 4,
  kOtherBytes = kSecondBytes + 4,
  kFirstRows,  ///< first rows of tets
  kOtherRows,
  kTetLabels,
  kFirstCorners,  ///< first corners of lists of samples
  kOtherCorners,
  kSides,
  kListSizes,
  kSamples,
  kColumns,
};

/// Which numbers of a quadric are alike: the diagonal of A, the rest of A, b, c.
constexpr std::array<std::size_t, 10> kKindOf{0, 1, 1, 0, 1, 0, 2, 2, 2, 3};

constexpr std::size_t kSumBytes = 4;
/// Columns go into one frame until they have as many bytes together.
constexpr std::size_t kFrameBytes = 512;

/// Takes a block's values one by one from where they stand and puts them where they belong.
struct Mover {
  std::array<ByteReader*, kColumns> from{};
  std::array<ByteWriter*, kColumns> to{};

  std::uint64_t number(std::size_t column) {
    const std::uint64_t value = from[column]->varint();
    to[column]->varint(value);
    return value;
  }
  void numbers(std::size_t column, int count) {
    for (; count > 0; --count) number(column);
  }
  std::uint64_t bytes(std::size_t column, std::size_t count) {
    const std::uint64_t value = from[column]->low_bytes(count);
    to[column]->low_bytes(value, count);
    return value;
  }

  void quadric() {
    const std::uint64_t codes = bytes(kQuadricCodes, 5);
    for (std::size_t i = 0; i < kKindOf.size(); ++i) {
      const std::size_t code = codes >> 4 * i & 15, size = code == kSameAsFirst ? 0 : code;
      if (size > kDoubleBytes) throw BadBytes{"a number has more than 8 bytes"};
      bytes(kOtherBytes, std::max<std::size_t>(size, 2) - 2);
      if (size > 1) bytes(kSecondBytes + kKindOf[i], 1);
      if (size > 0) bytes(kFirstBytes + kKindOf[i], 1);
    }
  }

  /// The order of values is that of to_kept() and encode_block().
  void block() {
    for (std::uint64_t labels = number(kCounts); labels > 0; --labels) number(kCounts);
    const std::uint64_t vertices = number(kCounts);
    numbers(kCounts, 3);
    for (std::uint64_t n = vertices; n > 0; --n) {
      number(kIds);
      for (std::size_t axis = 0; axis < 3; ++axis) number(kPositions + axis);
      quadric();
    }
    for (std::uint64_t tets = number(kCounts); tets > 0; --tets) {
      number(kFirstRows);
      numbers(kOtherRows, 3);
      number(kTetLabels);
    }
    number(kCounts);
    for (std::uint64_t lists = number(kCounts); lists > 0; --lists) {
      number(kFirstCorners);
      numbers(kOtherCorners, 2);
      number(kSides);
      for (std::uint64_t samples = number(kListSizes); samples > 0; --samples) number(kSamples);
    }
  }
};

}  // namespace

std::vector<std::byte> pack_blocks(std::span<const std::vector<std::byte>> blocks,
                                   io::ZstdPacker& packer) {
  std::array<ByteWriter, kColumns> columns;
  Mover mover;
  std::ranges::transform(columns, mover.to.begin(), [](ByteWriter& out) { return &out; });
  for (const std::vector<std::byte>& block : blocks) {
    ByteReader in(block);
    mover.from.fill(&in);
    mover.block();
  }
  ByteWriter head;
  std::vector<std::byte> frames, frame;
  for (ByteWriter& column : columns) {
    const std::span<const std::byte> bytes = column.written();
    head.varint(bytes.size());
    frame.insert(frame.end(), bytes.begin(), bytes.end());
    if (frame.size() < kFrameBytes && &column != &columns.back()) continue;
    packer.append(frame, frames);
    frame.clear();
  }
  std::vector<std::byte> out(kSumBytes);
  out.insert(out.end(), head.written().begin(), head.written().end());
  out.insert(out.end(), frames.begin(), frames.end());
  io::store_little<std::uint32_t>(io::checksum(std::span(out).subspan(kSumBytes)), out.data());
  return out;
}

std::vector<std::byte> unpack_block(std::span<const std::byte> packed, std::size_t index) {
  ByteReader in(packed);
  if (in.low_bytes(kSumBytes) != io::checksum(in.rest())) throw BadBytes{"its checksum is wrong"};
  std::array<std::size_t, kColumns> sizes{};
  for (std::size_t& size : sizes) size = in.varint();
  const std::vector<std::byte> joined = io::unpack_zstd(
      in.rest(), std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}), "versions");
  ByteReader all(joined);
  std::vector<ByteReader> columns;
  for (const std::size_t size : sizes) columns.emplace_back(all.bytes(size));
  Mover mover;
  std::ranges::transform(columns, mover.from.begin(), [](ByteReader& from) { return &from; });
  ByteWriter out;
  for (std::size_t i = 0; i <= index; ++i) {
    out = {};
    mover.to.fill(&out);
    mover.block();
  }
  return {out.written().begin(), out.written().end()};
}

}  // namespace mw::engine
