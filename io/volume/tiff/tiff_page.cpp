// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a page of a TIFF file says of itself.
#include "io/volume/tiff/tiff_stack.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/decode.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kMaxBlockBytes = 512 << 20;
/// More bytes than any codec gets out of one.
constexpr std::uint64_t kMaxRatio = 65536;

/// Returns a tag of that C++ type, or when it is missing the standard's value, else `otherwise`.
template <class T>
T tag(const TiffHandle& handle, std::uint32_t number, T otherwise) {
  T value{};
  return TIFFGetFieldDefaulted(handle.get(), number, &value) == 1 ? value : otherwise;
}

void refuse_no_labels(const TiffHandle& handle, const std::string& where) {
  const auto samples = tag<std::uint16_t>(handle, TIFFTAG_SAMPLESPERPIXEL, 1);
  if (samples != 1) {
    fail_input(handle.file(), where,
               text("pixels of ", samples, " samples (a colour picture?), labels are single ones"),
               "save one channel, or the indices of a palette");
  }
  if (const auto depth = tag<std::uint32_t>(handle, TIFFTAG_IMAGEDEPTH, 1); depth > 1) {
    fail_input(handle.file(), where, text("has a depth of ", depth, " slices"),
               "save one page a slice");
  }
  const auto packing = tag<std::uint16_t>(handle, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  if (TIFFIsCODECConfigured(packing) != 1) {
    fail_input(handle.file(), where, text("compression ", packing, " is not supported"),
               "save uncompressed or with deflate");
  }
}

VoxelType type_of(const TiffHandle& handle, const std::string& where) {
  const int bits = tag<std::uint16_t>(handle, TIFFTAG_BITSPERSAMPLE, 1);
  const auto format = tag<std::uint16_t>(handle, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  const bool sized = bits == 8 || bits == 16 || bits == 32 || bits == 64;
  const bool floating = format == SAMPLEFORMAT_IEEEFP && bits >= 32;
  const bool integer =
      format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_INT || format == SAMPLEFORMAT_VOID;
  if (!sized || (!floating && !integer)) {
    fail_input(handle.file(), where, text("samples of ", bits, " bits, format ", format),
               "use integers of 8 to 64 bits, bits, or whole numbers in floats of 32 or 64");
  }
  return floating ? float_type(bits / 8) : integer_type(bits / 8, format == SAMPLEFORMAT_INT);
}

/// Finds the type of pixels.  Bits become bytes where they are read.
void find_type(const TiffHandle& handle, TiffPage& page, const std::string& where) {
  page.has_bits = tag<std::uint16_t>(handle, TIFFTAG_BITSPERSAMPLE, 1) == 1;
  if (!page.has_bits) {
    page.type = type_of(handle, where);
    return;
  }
  page.zero_is_white = tag<std::uint16_t>(handle, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK) ==
                       PHOTOMETRIC_MINISWHITE;
}

void find_blocks(const TiffHandle& handle, TiffPage& page) {
  page.tiled = TIFFIsTiled(handle.get()) != 0;
  if (page.tiled) {
    page.block_width = tag<std::uint32_t>(handle, TIFFTAG_TILEWIDTH, 0);
    page.block_height = tag<std::uint32_t>(handle, TIFFTAG_TILELENGTH, 0);
    return;
  }
  page.block_width = page.width;
  page.block_height = std::min<std::int64_t>(
      page.height, tag<std::uint32_t>(handle, TIFFTAG_ROWSPERSTRIP, 0xffffffff));
}

void check_blocks(const TiffHandle& handle, const TiffPage& page, const std::string& where) {
  if (page.block_width < 1 || page.block_height < 1 || page.block_width > kMaxAxisVoxels ||
      page.block_height > kMaxAxisVoxels) {
    fail_input(handle.file(), where,
               text("strips or tiles of ", page.block_width, " x ", page.block_height, " pixels"),
               "the file is damaged");
  }
  const auto file_bytes =
      static_cast<std::uint64_t>(TIFFGetSizeProc(handle.get())(TIFFClientdata(handle.get())));
  const std::uint64_t block_bytes = page.block_pixel_bytes();
  if (block_bytes > kMaxBlockBytes || page.block_bytes() / kMaxRatio > file_bytes) {
    fail_input(
        handle.file(), where,
        text("one strip or tile unpacks to ", block_bytes, " bytes, the file has ", file_bytes),
        "the file is damaged; else save in smaller strips or tiles");
  }
}

}  // namespace

std::uint64_t TiffPage::block_bytes() const {
  if (!has_bits) return block_pixel_bytes();
  return static_cast<std::uint64_t>((block_width + 7) / 8 * block_height);
}

std::uint64_t TiffPage::block_pixel_bytes() const {
  return static_cast<std::uint64_t>(block_width * block_height) *
         static_cast<std::uint64_t>(byte_size(type));
}

std::string TiffPage::words() const {
  return text(width, " x ", height, " pixels of ", has_bits ? "1 bit" : name(type));
}

TiffPage read_tiff_page(const TiffHandle& handle, const std::string& where) {
  TiffPage page;
  const auto kind = tag<std::uint32_t>(handle, TIFFTAG_SUBFILETYPE, 0);
  page.smaller_copy = (kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0;
  if (page.smaller_copy) return page;
  const Index3 shape = checked_shape(handle.file(), text(where, ": size"),
                                     {tag<std::uint32_t>(handle, TIFFTAG_IMAGEWIDTH, 0),
                                      tag<std::uint32_t>(handle, TIFFTAG_IMAGELENGTH, 0), 1});
  page.width = shape.x;
  page.height = shape.y;
  refuse_no_labels(handle, where);
  find_type(handle, page, where);
  find_blocks(handle, page);
  check_blocks(handle, page, where);
  return page;
}

}  // namespace mw::io
