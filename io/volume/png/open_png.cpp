// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads PNG pictures as labels, by libpng.
#include "io/volume/png/open_png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>

#include "io/chunks/chunked_volume.h"
#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/volume/checks.h"

namespace mw::io {
namespace {

constexpr std::array<unsigned char, 8> kMagic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t kHeaderBytes = 33;  // magic, and the whole chunk IHDR
constexpr std::uint64_t kMaxBytes = 512 << 20;

/// What libpng reads from, and where it complains.
struct Stream {
  const ByteSource* source;
  std::uint64_t at = 0;
  std::size_t row_bytes = 0;
  std::array<char, 200> complaint{};
};

/// libpng leaves by longjmp, so that nothing in these frames may need a destructor.
[[noreturn]] void leave(png_structp png, png_const_charp complaint) {
  auto* stream = static_cast<Stream*>(png_get_error_ptr(png));
  std::snprintf(stream->complaint.data(), stream->complaint.size(), "%s", complaint);
  png_longjmp(png, 1);
}

void keep_silent(png_structp /*png*/, png_const_charp /*warning*/) {}

bool read_next(Stream& stream, std::byte* out, std::size_t count) {
  if (count > stream.source->size() - stream.at) return false;
  try {
    stream.source->read_at(stream.at, {out, count});
  } catch (const std::exception&) {
    return false;
  }
  stream.at += count;
  return true;
}

void read_bytes(png_structp png, png_bytep out, std::size_t count) {
  auto& stream = *static_cast<Stream*>(png_get_io_ptr(png));
  if (!read_next(stream, reinterpret_cast<std::byte*>(out), count)) png_error(png, "truncated");
}

/// Fills the rows; returns false with a complaint in the stream where libpng fails.
bool decode(Stream& stream, png_bytepp rows) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &stream, leave, keep_silent);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  // NOLINTNEXTLINE(cert-err52-cpp): libpng knows no other way.
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_read_fn(png, &stream, read_bytes);
  png_set_user_limits(png, kMaxAxisVoxels, kMaxAxisVoxels);
  png_read_info(png, info);
  png_set_packing(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  if (png_get_rowbytes(png, info) != stream.row_bytes) png_error(png, "the header changed");
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

void check_kind(const ByteSource& source, int depth, int kind) {
  constexpr int kGrey = 0, kPalette = 3;
  if (kind != kGrey && kind != kPalette) {
    fail_input(source.name(), "PNG colour type", text(kind, ": colours or transparency, no labels"),
               "save as grey values, or as indices of a palette");
  }
  if (depth != 1 && depth != 2 && depth != 4 && depth != 8 && depth != 16) {
    fail_input(source.name(), "PNG header", text(depth, " bits a pixel"), "the file is damaged");
  }
}

/// A slice is a chunk.
class PngChunks : public ChunkSource {
 public:
  PngChunks(std::vector<std::filesystem::path> files, const PngHeader& header)
      : files_(std::move(files)), header_(header) {}

  [[nodiscard]] std::string name() const override { return files_.front().parent_path().string(); }
  [[nodiscard]] std::string name_of(Index3 chunk) const override {
    return files_[static_cast<std::size_t>(chunk.z)].string();
  }
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& /*box*/,
                                          ChunkPlace /*place*/) const override {
    const FileSource file(files_[static_cast<std::size_t>(chunk.z)]);
    if (read_png_header(file) != header_) {
      fail_input(file.name(), "PNG header", "changed while it was read");
    }
    return Chunk{.bytes = read_png(file, header_), .strides = {1, header_.width, 0}};
  }
  /// The memory of the rows' addresses, and of libpng's window and rows.
  [[nodiscard]] std::uint64_t scratch_bytes() const override {
    constexpr std::uint64_t kLibrary = 1 << 20;
    return kLibrary + 8 * static_cast<std::uint64_t>(header_.height) + 4 * header_.row_bytes();
  }

 private:
  std::vector<std::filesystem::path> files_;
  PngHeader header_;
};

void check_alike(const std::vector<std::filesystem::path>& files, const PngHeader& first) {
  for (const std::filesystem::path& path : files) {
    const PngHeader header = read_png_header(FileSource(path));
    if (header == first) continue;
    fail_input(
        path.string(), "PNG header",
        text(header.width, " x ", header.height, " pixels of ", name(header.type),
             ", the first slice is ", first.width, " x ", first.height, " of ", name(first.type)),
        "save all slices of one size and type");
  }
}

}  // namespace

bool has_png_magic(std::span<const std::byte> head) {
  return head.size() >= kMagic.size() &&
         std::memcmp(head.data(), kMagic.data(), kMagic.size()) == 0;
}

PngHeader read_png_header(const ByteSource& source) {
  const std::vector<std::byte> head = read_prefix(source, kHeaderBytes);
  const bool whole = has_png_magic(head) && head.size() == kHeaderBytes;
  if (!whole || std::memcmp(&head[12], "IHDR", 4) != 0) {
    fail_input(source.name(), "PNG header", "missing", "the file is truncated or no PNG file");
  }
  const auto extent = [&](std::size_t at) {
    return static_cast<std::int64_t>(load<std::uint32_t>(&head[at], ByteOrder::kBig));
  };
  const Index3 shape = checked_shape(source.name(), "PNG size", {extent(16), extent(20), 1});
  const int depth = std::to_integer<int>(head[24]);
  check_kind(source, depth, std::to_integer<int>(head[25]));
  const PngHeader header{
      .width = shape.x, .height = shape.y, .type = depth == 16 ? VoxelType::kU16 : VoxelType::kU8};
  const std::uint64_t bytes = header.row_bytes() * static_cast<std::uint64_t>(shape.y);
  // Eight pixels of one bit are one byte when they are packed.
  if (bytes > kMaxBytes || !can_inflate_to(source.size(), bytes / 8)) {
    fail_input(source.name(), "PNG size",
               text(shape.x, " x ", shape.y, " pixels unpack to ", bytes, " bytes, the file has ",
                    source.size()),
               "the file is damaged; else save as TIFF in tiles");
  }
  return header;
}

std::vector<std::byte> read_png(const ByteSource& source, const PngHeader& header) {
  std::vector<std::byte> pixels(header.row_bytes() * static_cast<std::uint64_t>(header.height));
  std::vector<png_bytep> rows(static_cast<std::size_t>(header.height));
  for (std::size_t y = 0; y < rows.size(); ++y) {
    rows[y] = reinterpret_cast<png_bytep>(pixels.data() + y * header.row_bytes());
  }
  Stream stream{.source = &source, .row_bytes = static_cast<std::size_t>(header.row_bytes())};
  if (!decode(stream, rows.data())) {
    fail_input(source.name(), "PNG data",
               text("cannot be unpacked (", stream.complaint.data(), ")"),
               "the file is truncated or damaged");
  }
  return pixels;
}

std::unique_ptr<LabelVolume> open_png(std::unique_ptr<ByteSource> source,
                                      const OpenOptions& options) {
  return open_png_slices({source->name()}, options);
}

std::unique_ptr<LabelVolume> open_png_slices(std::vector<std::filesystem::path> files,
                                             const OpenOptions& options) {
  const PngHeader header = read_png_header(FileSource(files.front()));
  check_alike(files, header);
  VolumeInfo info{.shape = {header.width, header.height, static_cast<std::int64_t>(files.size())},
                  .type = header.type,
                  .format = "png",
                  .chunk = {header.width, header.height, 1}};
  info.space = placed(files.front().string(), {.is_sized = false}, options);
  const VoxelCoding coding{info.type, ByteOrder::kBig, {}};
  return std::make_unique<ChunkedVolume>(std::move(info), coding, ChunkFill{},
                                         std::make_unique<PngChunks>(std::move(files), header),
                                         options.cache_bytes);
}

}  // namespace mw::io
