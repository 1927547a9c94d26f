// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens PNG pictures, one or a slice each, as a volume: grey values, or indices of a palette.
// Format: https://www.w3.org/TR/png/
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/file/source/byte_source.h"
#include "io/volume/label_volume.h"
#include "io/volume/open_options.h"

namespace mw::io {

struct PngHeader {
  std::int64_t width = 0;
  std::int64_t height = 0;
  VoxelType type = VoxelType::kU8;  ///< pixels of 1, 2 and 4 bits are u8 too

  [[nodiscard]] std::uint64_t row_bytes() const {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(byte_size(type));
  }
  [[nodiscard]] bool operator==(const PngHeader&) const = default;
};

[[nodiscard]] bool has_png_magic(std::span<const std::byte> head);

/// ENSURES: the picture takes at most 512 MiB, and a file of this size can hold it.
/// ERRORS: mw::Error(kInput) naming the file, also for colours and transparency.
[[nodiscard]] PngHeader read_png_header(const ByteSource& source);

/// Returns the rows, from the top down; numbers of 16 bits are big-endian.
/// REQUIRES: header is that of the file.  ERRORS: those of read_png_header().
[[nodiscard]] std::vector<std::byte> read_png(const ByteSource& source, const PngHeader& header);

/// Opens one slice, which is read through its name, and as open_png_slices() opens several.
[[nodiscard]] std::unique_ptr<LabelVolume> open_png(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

/// Opens files as slices, in this order.  Rows go along x, from the top down along y.  Spacing is
/// 1, the first corner at 0.  REQUIRES: at least one file.
/// Cost: a slice is unpacked as one.
/// ERRORS: mw::Error(kInput) naming the file that is no labels, or not like the first.
[[nodiscard]] std::unique_ptr<LabelVolume> open_png_slices(std::vector<std::filesystem::path> files,
                                                           const OpenOptions& options);

}  // namespace mw::io
