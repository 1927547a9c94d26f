// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a page of a TIFF file by libtiff.
#include "io/volume/tiff/tiff_stack.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>

#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/decode.h"

namespace mw::io {
namespace {

using Stream = TiffHandle::Stream;

/// Reads fewer bytes at the end.  Errors must not pass through libtiff, so that they become its
/// own, as too few bytes.  Never returns -1: libtiff 4.5 takes it for a length when it clears the
/// rest of a block, and writes in front of its buffer.
tmsize_t read_bytes(thandle_t handle, void* out, tmsize_t count) {
  auto* stream = static_cast<Stream*>(handle);
  const std::uint64_t size = stream->source->size();
  const std::uint64_t left = size - std::min(stream->at, size);
  const auto length =
      static_cast<std::size_t>(std::min<std::uint64_t>(left, static_cast<std::uint64_t>(count)));
  if (length == 0) return 0;
  try {
    stream->source->read_at(stream->at, {static_cast<std::byte*>(out), length});
  } catch (const std::exception& error) {
    stream->complaint = error.what();
    return 0;
  }
  stream->at += length;
  return static_cast<tmsize_t>(length);
}

tmsize_t write_nothing(thandle_t /*handle*/, void* /*bytes*/, tmsize_t /*count*/) {
  return 0;
}

toff_t seek(thandle_t handle, toff_t offset, int from) {
  auto* stream = static_cast<Stream*>(handle);
  if (from == SEEK_CUR) offset += stream->at;
  if (from == SEEK_END) offset += stream->source->size();
  stream->at = offset;
  return offset;
}

int close_nothing(thandle_t /*handle*/) {
  return 0;
}

toff_t size_of(thandle_t handle) {
  return static_cast<Stream*>(handle)->source->size();
}

int keep_complaint(TIFF* /*tiff*/, void* stream, const char* /*module*/, const char* format,
                   va_list values) {
  std::array<char, 400> line{};
  std::vsnprintf(line.data(), line.size(), format, values);
  static_cast<Stream*>(stream)->complaint = line.data();
  return 1;
}

int keep_silent(TIFF* /*tiff*/, void* /*stream*/, const char* /*module*/, const char* /*format*/,
                va_list /*values*/) {
  return 1;
}

struct FreeOptions {
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

/// Returns the most that libtiff may take at once: tables and packed strips fit into the file.
tmsize_t max_memory(std::uint64_t file_bytes) {
  constexpr std::uint64_t kMin = 64 << 20;
  constexpr std::uint64_t kMax = std::uint64_t{1} << 40;
  return static_cast<tmsize_t>(kMin + 2 * std::min(file_bytes, kMax));
}

}  // namespace

TiffHandle::TiffHandle(std::shared_ptr<const ByteSource> source)
    : stream_{.source = std::move(source), .complaint = {}} {
  const std::unique_ptr<TIFFOpenOptions, FreeOptions> options(TIFFOpenOptionsAlloc());
  if (!options) throw Error(ErrorKind::kResource, file() + ": no memory to open it");
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), max_memory(stream_.source->size()));
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_complaint, &stream_);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_silent, nullptr);
  tiff_ = TIFFClientOpenExt(file().c_str(), "rm", &stream_, read_bytes, write_nothing, seek,
                            close_nothing, size_of, nullptr, nullptr, options.get());
  if (tiff_ == nullptr) fail("TIFF header", "cannot be read");
}

TiffHandle::~TiffHandle() {
  if (tiff_ != nullptr) TIFFClose(tiff_);
}

void TiffHandle::go_to(std::uint64_t directory) {
  stream_.complaint.clear();
  if (TIFFCurrentDirOffset(tiff_) == directory) return;
  if (TIFFSetSubDirectory(tiff_, directory) != 1) {
    fail(text("TIFF directory at offset ", directory), "cannot be read");
  }
}

void TiffHandle::fail(std::string_view field, std::string_view reason) const {
  std::string said(reason);
  if (!stream_.complaint.empty()) said += text(" (", stream_.complaint, ")");
  fail_input(file(), field, said, "the file is truncated or damaged");
}

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
               "use integers of 8 to 64 bits, or whole numbers in floats of 32 or 64");
  }
  return floating ? float_type(bits / 8) : integer_type(bits / 8, format == SAMPLEFORMAT_INT);
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
  if (page.block_bytes() > kMaxBlockBytes || page.block_bytes() / kMaxRatio > file_bytes) {
    fail_input(handle.file(), where,
               text("one strip or tile unpacks to ", page.block_bytes(), " bytes, the file has ",
                    file_bytes),
               "the file is damaged; else save in smaller strips or tiles");
  }
}

}  // namespace

std::uint64_t TiffPage::block_bytes() const {
  return static_cast<std::uint64_t>(block_width * block_height) *
         static_cast<std::uint64_t>(byte_size(type));
}

std::string TiffPage::words() const {
  return text(width, " x ", height, " pixels of ", name(type));
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
  page.type = type_of(handle, where);
  find_blocks(handle, page);
  check_blocks(handle, page, where);
  return page;
}

}  // namespace mw::io
