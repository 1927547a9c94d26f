// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a NIfTI-1 or NIfTI-2 volume in one file or two, with the names that it has for labels.
// Format: https://nifti.nimh.nih.gov/nifti-1 and https://nifti.nimh.nih.gov/nifti-2
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "io/file/byte_order.h"
#include "io/file/source/byte_source.h"
#include "io/names/label_names.h"
#include "io/volume/checks.h"
#include "io/volume/decode.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// The bytes of the longer header, that of version 2.
inline constexpr std::size_t kNiftiHeaderBytes = 540;

struct NiftiHeader {
  int version = 1;
  bool is_pair = false;  ///< the voxels are in a file of their own, .img beside .hdr
  ByteOrder order = ByteOrder::kLittle;
  VoxelType type = VoxelType::kU8;
  Index3 shape;
  std::int64_t masks = 1;  ///< how many volumes, one behind the other
  std::uint64_t data_offset = 0;
  VoxelScaling scaling{};
  /// The place by the sform, else the qform (NIfTI-1 methods 3 and 2), in RAS; else by pixdim alone
  /// (method 1), with an unknown orientation and the centre of the first voxel at 0.  The qform, if
  /// there is one, counts in place of an sform whose steps span no volume.  Callers may choose the
  /// form.
  FileSpace space;
  std::optional<FileSpace> qform{};  ///< the other place, where the file has both
  bool skips_sform = false;          ///< the qform counts for this reason
  /// The length of (b, c, d) where the qform counts; more than 1 is no rotation.
  double quaternion = 0;
};

/// Whether the bytes begin a NIfTI-1 or -2 header of either byte order, paired files included.
[[nodiscard]] bool has_nifti_magic(std::span<const std::byte> bytes);

/// REQUIRES: bytes is the beginning of the file, kNiftiHeaderBytes or as much as there is.
/// ERRORS: mw::Error(kInput) naming file and field; kUsage where the file lacks the form.
[[nodiscard]] NiftiHeader parse_nifti_header(std::span<const std::byte> bytes,
                                             std::string_view file,
                                             FormChoice form = FormChoice::kFile);

/// Returns the first label table (io/names/header_names.h) among the header extensions.  Extensions
/// that are damaged or hold something else are no error, as the voxels do not need them.
/// Memory: one extension and its XML tree; none above 4 MiB is looked at.
/// ERRORS: mw::Error(kInput) when the file cannot be read.
[[nodiscard]] LabelNames read_nifti_names(const ByteSource& source, const NiftiHeader& header);

/// The files of a volume.
struct NiftiFiles {
  std::unique_ptr<ByteSource> header;
  std::unique_ptr<ByteSource> image;  ///< null where it is not open yet, or not apart
};

/// Returns the file that was opened, and for an .img without a header in it the .hdr beside it.
/// ERRORS: mw::Error(kInput) naming the .img where there is none.
[[nodiscard]] NiftiFiles nifti_files(std::unique_ptr<ByteSource> source);

/// Opens the .img, gzipped or not, beside a .hdr.  ERRORS: mw::Error(kInput) where there is none.
[[nodiscard]] std::unique_ptr<ByteSource> open_nifti_image(const std::string& header);

/// Either of two files may be opened.  Several volumes in a file are masks
/// (io/volume/masks/open_masks.h), or numbers where options.values asks for them.  Bytes behind the
/// voxels are ignored. ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] std::unique_ptr<LabelVolume> open_nifti(std::unique_ptr<ByteSource> source,
                                                      const OpenOptions& options);

}  // namespace mw::io
