// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks compressed_segmentation, neuroglancer's encoding of labels, block by block.
#include "io/volume/precomputed/open_precomputed.h"

#include <bit>
#include <cstring>
#include <string>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "kernels/core/index.h"

namespace mw::io {
namespace {

/// Offsets count words of 32 bits.
constexpr std::size_t kWordBytes = 4;
/// A block's header: 24 bits for its table, 8 for the bits of a voxel, 32 for where voxels are.
constexpr std::size_t kHeaderBytes = 8;

Index3 grid_of(const SegmentationLayout& layout) {
  return cells_of({{0, 0, 0}, layout.shape}, layout.block).hi;
}

struct Block {
  Index3 number;
  Box3 box;               ///< its voxels that are in the chunk
  std::size_t table = 0;  ///< bytes from the start of the channel
  std::size_t values = 0;
  unsigned bits = 0;
};

/// One chunk while it is unpacked.
class Unpacker {
 public:
  Unpacker(std::span<const std::byte> packed, const SegmentationLayout& layout,
           std::string_view name)
      : channel_(packed), layout_(layout), name_(name) {}

  std::vector<std::byte> run() {
    enter_channel();
    const Index3 grid = grid_of(layout_);
    const auto voxel = static_cast<std::size_t>(byte_size(layout_.type));
    std::vector<std::byte> out(static_cast<std::size_t>(layout_.shape.product()) * voxel);
    for_each_index(grid, [&](Index3 number) {
      const Block block = read_header(number, grid);
      if (layout_.type == VoxelType::kU32) return unpack<4>(block, out.data());
      unpack<8>(block, out.data());
    });
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    fail_input(name_, "compressed_segmentation", reason, "get a whole copy of the store");
  }
  [[noreturn]] void fail_block(const Block& block, std::string_view reason) const {
    const Index3 n = block.number;
    fail(text("block (", n.x, ", ", n.y, ", ", n.z, "): ", reason));
  }

  /// The bytes begin with the offset of each channel, of which there is one.
  void enter_channel() {
    if (channel_.size() < kWordBytes) fail(text("truncated: ", channel_.size(), " bytes"));
    const auto start = load<std::uint32_t>(channel_.data(), ByteOrder::kLittle);
    if (start != 1) fail(text("the channel begins at word ", start, " instead of 1"));
    channel_ = channel_.subspan(kWordBytes);
    const std::size_t headers = kHeaderBytes * static_cast<std::size_t>(grid_of(layout_).product());
    if (channel_.size() >= headers) return;
    fail(text("truncated: ", channel_.size() + kWordBytes, " bytes, and the headers of the blocks ",
              "alone are ", headers));
  }

  Block read_header(Index3 number, Index3 grid) const {
    const Box3 all{{0, 0, 0}, grid};
    const std::byte* bytes =
        channel_.data() + kHeaderBytes * static_cast<std::size_t>(all.offset(number));
    const auto first = load<std::uint32_t>(bytes, ByteOrder::kLittle);
    const Index3 size = layout_.block;
    const Index3 lo{number.x * size.x, number.y * size.y, number.z * size.z};
    const Block block{.number = number,
                      .box = intersection({lo, lo + size}, {{0, 0, 0}, layout_.shape}),
                      .table = kWordBytes * (first & 0xffffffU),
                      .values = kWordBytes * load<std::uint32_t>(bytes + 4, ByteOrder::kLittle),
                      .bits = first >> 24U};
    check(block);
    return block;
  }

  void check(const Block& block) const {
    if (block.bits > 32 || (block.bits != 0 && !std::has_single_bit(block.bits))) {
      fail_block(block, text(block.bits, " bits a voxel are none of 0, 1, 2, 4, 8, 16 and 32"));
    }
    if (block.table > channel_.size()) fail_block(block, "its table is beyond the end");
    if (block.bits == 0) return;
    const Index3 last = block.box.shape() - Index3{1, 1, 1};
    const std::size_t end = block.values + kWordBytes * (bit_of(block, last) / 32 + 1);
    if (end > channel_.size()) fail_block(block, "its voxels reach beyond the end");
  }

  /// Returns where a voxel begins.  Blocks at the edge of the chunk are as large as elsewhere.
  std::size_t bit_of(const Block& block, Index3 v) const {
    const Index3 size = layout_.block;
    return block.bits * static_cast<std::size_t>(v.x + size.x * (v.y + size.y * v.z));
  }

  template <std::size_t kVoxelBytes>
  void unpack(const Block& block, std::byte* out) const {
    const std::byte* table = channel_.data() + block.table;
    const std::size_t known = (channel_.size() - block.table) / kVoxelBytes;
    const Box3 chunk{{0, 0, 0}, layout_.shape};
    const Index3 shape = block.box.shape();
    for (Index3 v; v.z < shape.z; ++v.z) {
      for (v.y = 0; v.y < shape.y; ++v.y) {
        v.x = 0;
        std::byte* row =
            out + kVoxelBytes * static_cast<std::size_t>(chunk.offset(block.box.lo + v));
        for (std::size_t bit = bit_of(block, v); v.x < shape.x; ++v.x, bit += block.bits) {
          const std::size_t value = value_at(block, bit);
          if (value >= known) fail_block(block, "a voxel's place in the table is beyond the end");
          std::memcpy(row, table + kVoxelBytes * value, kVoxelBytes);
          row += kVoxelBytes;
        }
      }
    }
  }

  std::size_t value_at(const Block& block, std::size_t bit) const {
    if (block.bits == 0) return 0;
    const auto word = load<std::uint32_t>(channel_.data() + block.values + kWordBytes * (bit / 32),
                                          ByteOrder::kLittle);
    return word >> bit % 32 & 0xffffffffU >> (32 - block.bits);
  }

  std::span<const std::byte> channel_;
  const SegmentationLayout& layout_;
  std::string_view name_;
};

}  // namespace

std::uint64_t max_segmentation_bytes(const SegmentationLayout& layout) {
  const auto blocks = static_cast<std::uint64_t>(grid_of(layout).product());
  const auto padded = static_cast<std::uint64_t>(layout.block.product());
  const auto voxels = static_cast<std::uint64_t>(layout.shape.product());
  return kWordBytes + blocks * (kHeaderBytes + kWordBytes * padded) +
         voxels * static_cast<std::uint64_t>(byte_size(layout.type));
}

std::vector<std::byte> unpack_segmentation(std::span<const std::byte> packed,
                                           const SegmentationLayout& layout,
                                           std::string_view name) {
  return Unpacker(packed, layout, name).run();
}

}  // namespace mw::io
