// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the blocks of pages as chunks of a volume.
#include "io/volume/tiff/tiff_stack.h"

#include <algorithm>
#include <cstring>

#include "io/file/errors.h"
#include "kernels/core/index.h"

namespace mw::io {
namespace {

constexpr std::int64_t kMinChunkBytes = 64 << 10;

/// A run of rows in memory, and the pixels of the page that it holds.
struct Pixels {
  Box3 box;
  std::byte* bytes;
};

/// Unpacks a block by its column and row on the page; rows is how many of its rows are in the page.
void unpack(const TiffHandle& handle, const TiffPage& page, Index3 block, std::int64_t rows,
            std::span<std::byte> out) {
  TIFF* tiff = handle.get();
  const std::int64_t across = (page.width + page.block_width - 1) / page.block_width;
  const auto number = static_cast<std::uint32_t>(block.y * across + block.x);
  if (TIFFGetStrileByteCount(tiff, number) == 0 && TIFFGetStrileOffset(tiff, number) == 0) {
    std::fill(out.begin(), out.end(), page.zero_is_white ? std::byte{0xff} : std::byte{0});
    return;
  }
  const std::uint64_t row_bytes =
      page.block_bytes() / static_cast<std::uint64_t>(page.block_height);
  const auto needed = static_cast<tmsize_t>(
      row_bytes * static_cast<std::uint64_t>(page.tiled ? page.block_height : rows));
  const tmsize_t got = page.tiled ? TIFFReadEncodedTile(tiff, number, out.data(), needed)
                                  : TIFFReadEncodedStrip(tiff, number, out.data(), needed);
  if (got == needed) return;
  handle.fail(text(page.tiled ? "tile " : "strip ", number), "cannot be unpacked");
}

/// Makes a byte of each bit: 1 where it is white.
void expand_bits(const TiffPage& page, std::span<const std::byte> bits, std::span<std::byte> out) {
  const auto width = static_cast<std::size_t>(page.block_width);
  const std::size_t row_bytes = (width + 7) / 8;
  for (std::size_t y = 0; y < static_cast<std::size_t>(page.block_height); ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const auto byte = std::to_integer<unsigned>(bits[y * row_bytes + x / 8]);
      const bool is_set = (byte >> (7 - x % 8) & 1U) != 0;
      out[y * width + x] = is_set != page.zero_is_white ? std::byte{1} : std::byte{0};
    }
  }
}

void copy_rows(const Pixels& from, const Pixels& to, std::size_t pixel) {
  const Box3 both = intersection(from.box, to.box);
  const auto length = static_cast<std::size_t>(both.shape().x) * pixel;
  for (Index3 v = both.lo; v.y < both.hi.y; ++v.y) {
    std::memcpy(to.bytes + static_cast<std::size_t>(to.box.offset(v)) * pixel,
                from.bytes + static_cast<std::size_t>(from.box.offset(v)) * pixel, length);
  }
}

}  // namespace

Index3 TiffChunks::chunk_shape() const {
  const TiffPage& page = stack_->first();
  if (page.tiled) return {page.block_width, page.block_height, 1};
  const auto strip = static_cast<std::int64_t>(page.block_pixel_bytes());
  const std::int64_t strips = std::max<std::int64_t>(1, (kMinChunkBytes + strip - 1) / strip);
  return {page.width, std::min(page.height, strips * page.block_height), 1};
}

std::string TiffChunks::name_of(Index3 chunk) const {
  return text(stack_->name_of(chunk.z), ": chunk (", chunk.x, ", ", chunk.y, ")");
}

std::optional<Chunk> TiffChunks::load(Index3 chunk, const Box3& box, ChunkPlace /*place*/) const {
  const TiffStack::Lease lease(*stack_, chunk.z);
  const TiffPage page = read_tiff_page(*lease, "page");
  if (!page.is_like(stack_->first())) (*lease).fail("page", "changed while it was read");
  const auto pixel = static_cast<std::size_t>(byte_size(page.type));
  const Box3 flat{{box.lo.x, box.lo.y, 0}, {box.hi.x, box.hi.y, 1}};
  Chunk out{.strides = {1, flat.shape().x, 0}};
  out.bytes.resize(static_cast<std::size_t>(flat.voxels()) * pixel);
  std::vector<std::byte> unpacked(static_cast<std::size_t>(page.block_bytes()));
  std::vector<std::byte> expanded(page.has_bits ? static_cast<std::size_t>(page.block_pixel_bytes())
                                                : 0);
  const Index3 size{page.block_width, page.block_height, 1};
  for (std::int64_t y = flat.lo.y / size.y; y * size.y < flat.hi.y; ++y) {
    for (std::int64_t x = flat.lo.x / size.x; x * size.x < flat.hi.x; ++x) {
      const Index3 lo{x * size.x, y * size.y, 0};
      unpack(*lease, page, {x, y, 0}, std::min(size.y, page.height - lo.y), unpacked);
      if (page.has_bits) expand_bits(page, unpacked, expanded);
      std::byte* pixels = page.has_bits ? expanded.data() : unpacked.data();
      copy_rows({{lo, lo + size}, pixels}, {flat, out.bytes.data()}, pixel);
    }
  }
  return out;
}

}  // namespace mw::io
