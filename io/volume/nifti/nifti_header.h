// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The header of a single-file NIfTI-1 or NIfTI-2 volume.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "io/file/byte_order.h"
#include "io/volume/decode.h"
#include "io/volume/file_space.h"

namespace mw::io {

/// Bytes that hold a header of either version.
inline constexpr std::size_t kNiftiHeaderBytes = 540;

struct NiftiHeader {
  int version = 1;
  ByteOrder order = ByteOrder::kLittle;
  VoxelType type = VoxelType::kU8;
  Index3 shape;
  std::uint64_t data_offset = 0;
  VoxelScaling scaling{};
  /// By the sform, else the qform (NIfTI-1 methods 3 and 2), in RAS; else by pixdim alone (method
  /// 1), of an unknown orientation, the centre of the first voxel at 0.
  FileSpace space;
};

/// Whether the bytes begin a NIfTI-1 or -2 header of either byte order, paired files included.
[[nodiscard]] bool has_nifti_magic(std::span<const std::byte> bytes);

/// REQUIRES: bytes is the beginning of the file, kNiftiHeaderBytes or as much as there is.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] NiftiHeader parse_nifti_header(std::span<const std::byte> bytes,
                                             std::string_view file);

}  // namespace mw::io
