// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a NumPy .npy file, versions 1 to 3 of its header, as a volume.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/file/byte_order.h"
#include "io/file/source/byte_source.h"
#include "io/volume/label_volume.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// Bytes 0..11: magic, version, length of the dictionary that follows.
struct NpyPrefix {
  std::size_t dict_offset = 0;
  std::size_t dict_length = 0;
};

/// The dictionary.  Array axes are [z, y, x] (or [y, x], one slice).
struct NpyHeader {
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
  bool fortran_order = false;
  Index3 shape;
};

[[nodiscard]] bool has_npy_magic(std::span<const std::byte> bytes);

/// ERRORS of both: mw::Error(kInput) naming file and field.
[[nodiscard]] NpyPrefix parse_npy_prefix(std::span<const std::byte> bytes, std::string_view file);
[[nodiscard]] NpyHeader parse_npy_dict(std::string_view dict, std::string_view file);

/// A whole version 1.0 header, padded to a multiple of 64 bytes, for a C-order array [z, y, x].
[[nodiscard]] std::string format_npy_header(const VolumeInfo& info);

/// Axes of the array are [z, y, x]; both C and Fortran order.  The format knows neither spacing
/// nor origin: 1 and 0.  Bytes behind the voxels are ignored, as numpy does.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] std::unique_ptr<LabelVolume> open_npy(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

}  // namespace mw::io
