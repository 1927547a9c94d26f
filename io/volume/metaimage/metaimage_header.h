// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text header of a MetaImage volume (.mha, .mhd), as ITK and VTK write it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/file/byte_order.h"
#include "io/volume/file_space.h"

namespace mw::io {

/// Largest header looked for, bytes, a list of slices behind it included.
inline constexpr std::size_t kMaxMetaImageBytes = 16 << 20;

struct MetaImageHeader {
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
  Index3 shape;
  bool compressed = false;                    ///< one zlib (or gzip) stream
  std::optional<std::uint64_t> packed_bytes;  ///< of that stream, where the header says it
  /// Bytes in front of the voxels, from the beginning of their file; -1: they are its last bytes.
  std::int64_t header_size = 0;
  std::string data_file;  ///< the value of ElementDataFile: "LOCAL", a name, a pattern, "LIST"
  std::size_t bytes = 0;  ///< length of the header with the line of ElementDataFile
  /// Row i of TransformMatrix is the direction of array axis i, Offset the centre of the first
  /// voxel (absent: 0), and coordinates are left-posterior-superior, as ITK has them.
  FileSpace space;
};

[[nodiscard]] bool has_metaimage_magic(std::span<const std::byte> head);

/// REQUIRES: head is the beginning of the file, kMaxMetaImageBytes or as much as there is.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] MetaImageHeader parse_metaimage_header(std::string_view head, std::string_view file);

}  // namespace mw::io
