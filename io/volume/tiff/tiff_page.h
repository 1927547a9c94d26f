// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the directory of a TIFF page says of its pixels.
#pragma once

#include <cstdint>
#include <string>

#include "io/volume/label_volume.h"
#include "io/volume/tiff/tiff_handle.h"

namespace mw::io {

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
