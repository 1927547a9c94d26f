// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A TIFF file in the hands of libtiff, and what the directory of a page says of its pixels.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "io/file/source/byte_source.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// libtiff over a ByteSource: it opens nothing itself, prints nothing, and takes no piece of memory
/// that is large against the file.  Thread safety: none; handles of one source may be used at once.
class TiffHandle {
 public:
  /// Stands at the first page.
  /// ERRORS: mw::Error(kInput) naming the file when it is no TIFF file.
  explicit TiffHandle(std::shared_ptr<const ByteSource> source);
  ~TiffHandle();
  TiffHandle(const TiffHandle&) = delete;
  TiffHandle& operator=(const TiffHandle&) = delete;

  /// Stands at the page whose directory begins there.
  /// ERRORS: mw::Error(kInput) naming file and place.
  void go_to(std::uint64_t directory);

  [[nodiscard]] TIFF* get() const { return tiff_; }
  [[nodiscard]] const std::string& file() const { return stream_.source->name(); }
  /// Throws mw::Error(kInput) with what libtiff said last.
  [[noreturn]] void fail(std::string_view field, std::string_view reason) const;

  /// What libtiff reads from, and where it complains.
  struct Stream {
    std::shared_ptr<const ByteSource> source;
    std::uint64_t at = 0;
    std::string complaint;
  };

 private:
  Stream stream_;
  TIFF* tiff_ = nullptr;
};

struct TiffPage {
  std::int64_t width = 0;
  std::int64_t height = 0;
  VoxelType type = VoxelType::kU8;
  /// Pixels are packed in blocks of so many, from the top left corner on: strips or tiles.
  std::int64_t block_width = 0;
  std::int64_t block_height = 0;
  bool tiled = false;
  bool smaller_copy = false;  ///< a thumbnail, a level of a pyramid or a mask: no slice

  /// What a block unpacks to; the last strip of a page is shorter.
  [[nodiscard]] std::uint64_t block_bytes() const;
  /// 5 x 4 pixels of u8.
  [[nodiscard]] std::string words() const;
  [[nodiscard]] bool is_like(const TiffPage& other) const {
    return width == other.width && height == other.height && type == other.type;
  }
};

/// Of the page where the handle stands.  place: what errors call it, "page 3".
/// ENSURES: extents within kMaxAxisVoxels; blocks that the file can hold, below 512 MiB.
/// ERRORS: mw::Error(kInput) naming file and page for pixels that are no labels: of several
/// samples, of a type or compression that is not read, or of a depth.
[[nodiscard]] TiffPage read_tiff_page(const TiffHandle& handle, const std::string& where);

}  // namespace mw::io
