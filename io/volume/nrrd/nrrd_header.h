// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text header of an NRRD volume, inline or detached.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/file/byte_order.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// Largest header looked for, bytes.
inline constexpr std::size_t kMaxNrrdHeaderBytes = 1 << 20;

struct NrrdHeader {
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
  Index3 shape;
  bool gzip = false;
  std::int64_t byte_skip = 0;  ///< -1: the voxels are the last bytes of the file
  std::string data_file;       ///< empty: the voxels follow the header
  std::size_t bytes = 0;       ///< length of the header with its blank line
  /// As stored, not yet checked; norms of `space directions` or `spacings`.
  std::optional<std::array<double, 3>> spacing;
  std::optional<std::array<double, 3>> space_origin;  ///< centre of the first voxel
};

[[nodiscard]] bool has_nrrd_magic(std::string_view text);

/// REQUIRES: head is the beginning of the file, kMaxNrrdHeaderBytes or as much as there is.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] NrrdHeader parse_nrrd_header(std::string_view head, std::string_view file);

/// ERRORS: kInput unless finite and positive.  1 when the file says nothing.
[[nodiscard]] std::array<double, 3> nrrd_spacing(const NrrdHeader& header, std::string_view file);

/// The corner of the first voxel.  `space origin` is the centre of the first sample whatever the
/// centering (format definition), so half a voxel is taken off along each axis; 0 when absent.
/// Axes stay those of the array: a rotation in `space directions` is not applied.
[[nodiscard]] std::array<double, 3> nrrd_origin(const NrrdHeader& header,
                                                const std::array<double, 3>& spacing,
                                                std::string_view file);

}  // namespace mw::io
