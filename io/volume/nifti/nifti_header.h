// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The header of a single-file NIfTI-1 or NIfTI-2 volume.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "io/file/byte_order.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// Bytes that hold a header of either version.
inline constexpr std::size_t kNiftiHeaderBytes = 540;

struct NiftiHeader {
  int version = 1;
  ByteOrder order = ByteOrder::kLittle;
  VoxelType type = VoxelType::kU8;
  Index3 shape;
  std::uint64_t data_offset = 0;
  std::array<double, 3> pixdim{};  ///< pixdim[1..3] as stored, not yet checked
  /// Centre of the first voxel: the translation of the sform, else of the qform, else none.
  std::optional<std::array<double, 3>> first_centre;
};

/// Whether the bytes begin a NIfTI-1 or -2 header of either byte order, paired files included.
[[nodiscard]] bool has_nifti_magic(std::span<const std::byte> bytes);

/// REQUIRES: bytes is the beginning of the file, kNiftiHeaderBytes or as much as there is.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] NiftiHeader parse_nifti_header(std::span<const std::byte> bytes,
                                             std::string_view file);

/// |pixdim|.  ERRORS: kInput naming pixdim[i] unless finite and not 0.
[[nodiscard]] std::array<double, 3> nifti_spacing(const NiftiHeader& header, std::string_view file);

/// The corner of the first voxel: its centre minus half a voxel along each axis; 0 when the file
/// places nothing.  Axes stay those of the array: a rotation or flip in the file is not applied.
/// ERRORS: kInput when not finite.
[[nodiscard]] std::array<double, 3> nifti_origin(const NiftiHeader& header,
                                                 const std::array<double, 3>& spacing,
                                                 std::string_view file);

}  // namespace mw::io
