// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text header of a MetaImage volume (.mha, .mhd), as ITK and VTK write it.
// Format: https://itk.org/Wiki/ITK/MetaIO/Documentation
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_order.h"
#include "io/file/source/byte_source.h"
#include "io/volume/checks.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// The most bytes of a header that is looked for, with a list of slices behind it.
inline constexpr std::size_t kMaxMetaImageBytes = 16 << 20;

struct MetaImageHeader {
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
  Index3 shape;
  bool compressed = false;                    ///< one zlib (or gzip) stream
  std::optional<std::uint64_t> packed_bytes;  ///< its length, where the header says it
  /// How many bytes of their file are in front of the voxels; -1: they are its last bytes.
  std::int64_t header_size = 0;
  std::string data_file;  ///< the value of ElementDataFile: "LOCAL", a name, a pattern, "LIST"
  std::size_t bytes = 0;  ///< length of the header with the line of ElementDataFile
  /// Row i of TransformMatrix is the direction of array axis i, Offset is the centre of the first
  /// voxel (0 where it is absent), and coordinates are left-posterior-superior, as ITK has them.
  FileSpace space;
};

[[nodiscard]] bool has_metaimage_magic(std::span<const std::byte> head);

/// REQUIRES: head is the beginning of the file, kMaxMetaImageBytes or as much as there is.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] MetaImageHeader parse_metaimage_header(std::string_view head, std::string_view file);

/// Whether a value of ElementDataFile names many files: "LIST", or a pattern with %.
[[nodiscard]] bool names_many_files(std::string_view data_file);

/// Returns the names of `count` files, first slice first.  For "LIST" they are the lines behind the
/// header, else they follow from "PATTERN FIRST LAST STEP" (FIRST and STEP are 1 where they are
/// missing), where PATTERN has one %d, which may have a width, as in %03d.
/// ERRORS: mw::Error(kInput) naming the file and its field.
[[nodiscard]] std::vector<std::string> slice_names(std::string_view data_file,
                                                   std::string_view behind_header,
                                                   std::int64_t count, std::string_view file);

/// Opens a file whose voxels follow the header, or are in one or many files beside it or in folders
/// below; source.name() tells where it is.
/// Compressed voxels are inflated into a temporary file.  Bytes behind the voxels are ignored.
/// ERRORS: mw::Error(kInput) naming file and field; kResource when the disk is full.
[[nodiscard]] std::unique_ptr<LabelVolume> open_metaimage(std::unique_ptr<ByteSource> source,
                                                          const OpenOptions& options);

}  // namespace mw::io
