// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a TIFF, BigTIFF or OME-TIFF stack as a volume.
#pragma once

#include <filesystem>
#include <vector>

#include "io/file/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

[[nodiscard]] bool has_tiff_magic(std::span<const std::byte> head);

/// Pages are slices, first page first; a stack of ImageJ may have one page for all its slices. Rows
/// go along x, from the top down along y.  The first corner is at 0; spacing and unit are those of
/// OME-XML or ImageJ, else 1.
/// ERRORS: mw::Error(kInput) naming file and page.
[[nodiscard]] std::unique_ptr<LabelVolume> open_tiff(std::unique_ptr<ByteSource> source,
                                                     const OpenOptions& options);

/// Files are slices, in this order.  REQUIRES: at least one.
/// ERRORS: mw::Error(kInput) naming the file that is not like the first.
[[nodiscard]] std::unique_ptr<LabelVolume> open_tiff_slices(
    std::vector<std::filesystem::path> files, const OpenOptions& options);

}  // namespace mw::io
