// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a stack of TIFF pages as a volume.
#include "io/volume/tiff/open_tiff.h"

#include <cstring>
#include <limits>
#include <pugixml.hpp>

#include "io/chunks/chunked_volume.h"
#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/raw_array.h"
#include "io/volume/tiff/tiff_stack.h"

namespace mw::io {
namespace {

VolumeInfo info_of(const TiffStack& stack, const TiffDescription& said,
                   const OpenOptions& options) {
  const TiffPage& page = stack.first();
  VolumeInfo info{
      .shape = {page.width, page.height, stack.slices()}, .type = page.type, .format = "tiff"};
  FileSpace space{.unit = said.unit,
                  .steps_field = "voxel size in ImageDescription",
                  .is_sized = said.is_sized};
  space.steps = steps_of(said.spacing);
  info.space = placed(stack.name(), space, options);
  if (!options.spacing && !said.note.empty()) info.note = text(stack.name(), ": ", said.note);
  return info;
}

std::unique_ptr<LabelVolume> chunked(std::unique_ptr<TiffStack> stack, VolumeInfo info,
                                     const OpenOptions& options) {
  auto chunks = std::make_unique<TiffChunks>(std::move(stack));
  info.chunk = chunks->chunk_shape();
  const VoxelCoding coding{info.type, kHostOrder, {}};
  return std::make_unique<ChunkedVolume>(std::move(info), coding, ChunkFill{}, std::move(chunks),
                                         options.cache_bytes);
}

/// Returns where the pixels of a page begin if it is unpacked and its strips are in a row, else 0.
std::uint64_t plain_pixels(TIFF* tiff) {
  std::uint16_t packing = COMPRESSION_NONE;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &packing);
  if (packing != COMPRESSION_NONE || TIFFIsTiled(tiff) != 0) return 0;
  const std::uint32_t strips = TIFFNumberOfStrips(tiff);
  for (std::uint32_t i = 1; i < strips; ++i) {
    const std::uint64_t end =
        TIFFGetStrileOffset(tiff, i - 1) + TIFFGetStrileByteCount(tiff, i - 1);
    if (TIFFGetStrileOffset(tiff, i) != end) return 0;
  }
  return TIFFGetStrileOffset(tiff, 0);
}

/// ImageJ writes stacks above 4 GiB as one page: the slices behind the first just follow it.
std::unique_ptr<LabelVolume> open_one_page(std::unique_ptr<ByteSource> source,
                                           const TiffStack& stack, VolumeInfo info,
                                           std::int64_t slices) {
  const TiffStack::Lease lease(stack, 0);
  const std::uint64_t offset = plain_pixels((*lease).get());
  if (offset == 0 || stack.first().has_bits) {
    fail_input(source->name(), "ImageJ images",
               text("the stack claims ", slices,
                    " slices, the file has one page that is packed, or of bits"),
               "save the stack again");
  }
  const Index3 shape =
      checked_shape(source->name(), "ImageJ images", {info.shape.x, info.shape.y, slices});
  info.shape = shape;
  check_payload(*source, info, offset);
  const bool big = TIFFIsBigEndian((*lease).get()) != 0;
  return std::make_unique<RawArrayVolume>(
      std::move(source), std::move(info),
      ArrayLayout{.offset = offset, .order = big ? ByteOrder::kBig : ByteOrder::kLittle});
}

}  // namespace

bool has_tiff_magic(std::span<const std::byte> head) {
  if (head.size() < 4) return false;
  for (const char* magic : {"II*\0", "MM\0*", "II+\0", "MM\0+"}) {
    if (std::memcmp(head.data(), magic, 4) == 0) return true;
  }
  return false;
}

std::unique_ptr<LabelVolume> open_tiff(std::unique_ptr<ByteSource> source,
                                       const OpenOptions& options) {
  const std::shared_ptr<const ByteSource> file = std::move(source);
  auto stack = std::make_unique<TiffStack>(file);
  const TiffDescription said =
      parse_tiff_description(stack->description(), stack->resolution(), file->name());
  VolumeInfo info = info_of(*stack, said, options);
  const std::int64_t slices = said.slices.value_or(stack->slices());
  if (said.is_imagej && stack->slices() == 1 && slices > 1) {
    return open_one_page(std::make_unique<BytesPart>(file, 0, file->size(), file->name()), *stack,
                         std::move(info), slices);
  }
  if (slices != stack->slices()) {
    fail_input(file->name(), "ImageDescription",
               text("claims ", slices, " slices, the file has ", stack->slices(), " pages"),
               "the others may be in files beside it: save them as one file");
  }
  return chunked(std::move(stack), std::move(info), options);
}

std::unique_ptr<LabelVolume> open_tiff_slices(std::vector<std::filesystem::path> files,
                                              const OpenOptions& options) {
  auto stack = std::make_unique<TiffStack>(std::move(files));
  const TiffDescription said = parse_tiff_description({}, stack->resolution(), stack->name());
  VolumeInfo info = info_of(*stack, said, options);
  return chunked(std::move(stack), std::move(info), options);
}

}  // namespace mw::io
