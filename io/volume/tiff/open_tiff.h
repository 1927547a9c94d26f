// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a TIFF, BigTIFF or OME-TIFF stack as a volume, as its ImageDescription says.
// Format: https://www.itu.int/itudoc/itu-t/com16/tiff-fx/docs/tiff6.pdf
// Format: https://www.awaresystems.be/imaging/tiff/bigtiff.html
// Format: https://docs.openmicroscopy.org/ome-model/latest/ome-tiff/specification.html
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/source/byte_source.h"
#include "io/volume/open_options.h"
#include "io/volume/tiff/tiff_stack.h"
#include "io/volume/volume_space.h"

namespace mw::io {

struct TiffDescription {
  /// Edges of a voxel in `unit`; NaN where only those of other axes are known.
  Vector3 spacing{1, 1, 1};
  std::string unit;                    ///< "um", "nm" and so on; empty: unknown
  std::optional<std::int64_t> slices;  ///< how many there are
  bool is_sized = false;               ///< it says how large voxels are
  bool is_imagej = false;
  std::string note;  ///< what is assumed where it leaves something open
};

/// ImageJ tells the spacing of x and y by the resolution.  That of other files often counts dots on
/// paper, and is not used; a note says so where it is in centimetres.
/// ERRORS: mw::Error(kInput) naming file and field for several channels, times or images, and for
/// OME-XML whose slices are in other files or another order.
[[nodiscard]] TiffDescription parse_tiff_description(std::string_view description,
                                                     const TiffResolution& resolution,
                                                     const std::string& file);

[[nodiscard]] bool has_tiff_magic(std::span<const std::byte> head);

/// Opens pages as slices, first page first; a stack of ImageJ may have one page for all its slices.
/// Rows go along x, from the top down along y.  The first corner is at 0; spacing and unit are
/// those of OME-XML or ImageJ, else 1.
/// ERRORS: mw::Error(kInput) naming file and page.
[[nodiscard]] std::unique_ptr<LabelVolume> open_tiff(std::unique_ptr<ByteSource> source,
                                                     const OpenOptions& options);

/// Opens files as slices, in this order.  REQUIRES: at least one.
/// ERRORS: mw::Error(kInput) naming the file that is not like the first.
[[nodiscard]] std::unique_ptr<LabelVolume> open_tiff_slices(
    std::vector<std::filesystem::path> files, const OpenOptions& options);

}  // namespace mw::io
