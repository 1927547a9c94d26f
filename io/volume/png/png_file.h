// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One PNG picture as labels: grey values, or indices of a palette.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/file/byte_source.h"
#include "io/volume/label_volume.h"

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

/// ENSURES: a picture that the file can hold, below 512 MiB.
/// ERRORS of both: mw::Error(kInput) naming the file, also for colours and transparency.
[[nodiscard]] PngHeader read_png_header(const ByteSource& source);

/// The rows, from the top down; numbers of 16 bits are big-endian.
/// REQUIRES: header is that of the file.
[[nodiscard]] std::vector<std::byte> read_png(const ByteSource& source, const PngHeader& header);

}  // namespace mw::io
