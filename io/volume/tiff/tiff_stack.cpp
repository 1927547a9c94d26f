// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads pages of TIFF files as the slices of a volume.
#include "io/volume/tiff/tiff_stack.h"

#include <algorithm>
#include <cstring>

#include "io/file/errors.h"
#include "io/file/source/file_source.h"
#include "io/file/text_numbers.h"
#include "io/volume/checks.h"
#include "kernels/core/index.h"

namespace mw::io {
namespace {

/// How many handles are kept open between reads: about as many as threads work at once.
constexpr std::size_t kMaxIdle = 16;

std::shared_ptr<const ByteSource> open_file(const std::filesystem::path& path) {
  auto file = std::make_shared<FileSource>(path);
  if (file->size() == 0) fail_input(file->name(), {}, "the file is empty", "check how it was made");
  return file;
}

std::string description_of(const TiffHandle& handle) {
  const char* description = nullptr;
  const bool found = TIFFGetField(handle.get(), TIFFTAG_IMAGEDESCRIPTION, &description) == 1;
  return found ? description : "";
}

TiffResolution resolution_of(const TiffHandle& handle) {
  const auto pixels = [&](std::uint32_t tag) {
    float value = 0;
    return TIFFGetField(handle.get(), tag, &value) == 1 ? decimal_of(value) : 0;
  };
  std::uint16_t unit = RESUNIT_NONE;
  const bool has_unit = TIFFGetField(handle.get(), TIFFTAG_RESOLUTIONUNIT, &unit) == 1;
  TiffResolution out{.pixels = {pixels(TIFFTAG_XRESOLUTION), pixels(TIFFTAG_YRESOLUTION)}};
  out.per_centimetre = has_unit && unit == RESUNIT_CENTIMETER && out.pixels[0] > 0;
  return out;
}

}  // namespace

TiffStack::TiffStack(std::shared_ptr<const ByteSource> file)
    : file_(std::move(file)), name_(file_->name()) {
  const TiffHandle handle(file_);
  std::int64_t pages = 0;
  while (true) {
    add_page(handle, text("page ", ++pages));
    if (slices() > kMaxAxisVoxels) {
      fail_input(name_, "pages", text("more than ", kMaxAxisVoxels), "cut the volume into parts");
    }
    if (TIFFLastDirectory(handle.get()) != 0) break;
    if (TIFFReadDirectory(handle.get()) != 1) {
      handle.fail(text("page ", pages + 1), "cannot be read");
    }
  }
  if (positions_.empty()) {
    fail_input(name_, "pages", "there are only smaller copies of others", "save whole pages");
  }
}

TiffStack::TiffStack(std::vector<std::filesystem::path> files)
    : files_(std::move(files)), name_(files_.front().parent_path().string()) {
  for (const std::filesystem::path& path : files_) {
    const TiffHandle handle(open_file(path));
    const std::size_t before = positions_.size();
    add_page(handle, "page 1");
    if (TIFFLastDirectory(handle.get()) == 0 || positions_.size() == before) {
      fail_input(path.string(), "pages", "it has several, or none that is a slice",
                 "a folder's files are one slice each: give a file of many pages by its name");
    }
  }
}

void TiffStack::add_page(const TiffHandle& handle, const std::string& position) {
  const TiffPage page = read_tiff_page(handle, position);
  if (page.smaller_copy) return;
  if (positions_.empty()) {
    first_ = page;
    description_ = description_of(handle);
    resolution_ = resolution_of(handle);
  }
  if (!page.is_like(first_)) {
    fail_input(handle.file(), position, text(page.words(), ", the first slice is ", first_.words()),
               "save all slices of one size and type");
  }
  largest_block_ = std::max(largest_block_, page.block_bytes());
  positions_.push_back(TIFFCurrentDirOffset(handle.get()));
}

std::string TiffStack::name_of(std::int64_t slice) const {
  if (!files_.empty()) return files_[static_cast<std::size_t>(slice)].string();
  return text(name_, ": slice ", slice + 1);
}

/// Returns a handle that stands there, else any other of the same file, else a new one.
std::unique_ptr<TiffHandle> TiffStack::take(std::int64_t slice) const {
  {
    const std::lock_guard lock(mutex_);
    auto found = std::find_if(idle_.begin(), idle_.end(),
                              [&](const Idle& idle) { return idle.slice == slice; });
    if (found == idle_.end() && files_.empty() && !idle_.empty()) found = idle_.end() - 1;
    if (found != idle_.end()) {
      auto handle = std::move(found->handle);
      idle_.erase(found);
      return handle;
    }
  }
  if (files_.empty()) return std::make_unique<TiffHandle>(file_);
  return std::make_unique<TiffHandle>(open_file(files_[static_cast<std::size_t>(slice)]));
}

void TiffStack::give_back(std::int64_t slice, std::unique_ptr<TiffHandle> handle) const {
  const std::lock_guard lock(mutex_);
  if (idle_.size() == kMaxIdle) idle_.erase(idle_.begin());
  idle_.push_back({slice, std::move(handle)});
}

TiffStack::Lease::Lease(const TiffStack& stack, std::int64_t slice)
    : stack_(stack), slice_(slice), handle_(stack.take(slice)) {
  handle_->go_to(stack.positions_[static_cast<std::size_t>(slice)]);
}

TiffStack::Lease::~Lease() {
  if (handle_) stack_.give_back(slice_, std::move(handle_));
}

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
    std::fill(out.begin(), out.end(), std::byte{0});
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
  const auto strip = static_cast<std::int64_t>(page.block_bytes());
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
  const Index3 size{page.block_width, page.block_height, 1};
  for (std::int64_t y = flat.lo.y / size.y; y * size.y < flat.hi.y; ++y) {
    for (std::int64_t x = flat.lo.x / size.x; x * size.x < flat.hi.x; ++x) {
      const Index3 lo{x * size.x, y * size.y, 0};
      unpack(*lease, page, {x, y, 0}, std::min(size.y, page.height - lo.y), unpacked);
      copy_rows({{lo, lo + size}, unpacked.data()}, {flat, out.bytes.data()}, pixel);
    }
  }
  return out;
}

}  // namespace mw::io
