// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pages of TIFF files as the slices of a volume.
#include "io/volume/tiff/tiff_stack.h"

#include <algorithm>

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
  largest_block_ = std::max(largest_block_, page.block_pixel_bytes());
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

}  // namespace mw::io
