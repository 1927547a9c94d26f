// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a volume of FreeSurfer (.mgh, .mgz), with the names of labels in the colour table beside
// it. Format: https://surfer.nmr.mgh.harvard.edu/fswiki/FsTutorial/MghFormat
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "io/file/source/byte_source.h"
#include "io/volume/checks.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// The bytes in front of the voxels.
inline constexpr std::size_t kMghHeaderBytes = 284;

/// The name of the colour table, in the folder of the volume, that names its labels.
inline constexpr const char* kFreeSurferTable = "FreeSurferColorLUT.txt";

/// All numbers of the format have the most significant byte first.
struct MghHeader {
  VoxelType type = VoxelType::kU8;
  Index3 shape;
  std::int64_t frames = 1;  ///< volumes, one behind the other
  /// The place by the directions and the centre, as nibabel has it, in RAS and mm.  Where
  /// `goodRASFlag` says that there are none, it is FreeSurfer's default: coronal slices of voxels
  /// of 1 mm, the middle at 0.
  FileSpace space;
};

/// Whether the bytes begin a header that makes sense: the format has a version for a magic, which
/// is 1, so that shape and type are looked at, too.
[[nodiscard]] bool has_mgh_magic(std::span<const std::byte> bytes);

/// REQUIRES: bytes is the beginning of the file, kMghHeaderBytes or as much as there is.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] MghHeader parse_mgh_header(std::span<const std::byte> bytes, std::string_view file);

/// Several frames in a file are masks, or numbers (open_series()).  Bytes behind the voxels are
/// ignored.  A colour table beside the file that cannot be read is no error, which a note says.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] std::unique_ptr<LabelVolume> open_mgh(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

}  // namespace mw::io
