// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a folder of slices, TIFF or PNG files, as a volume.
#pragma once

#include <filesystem>

#include "io/volume/open_options.h"

namespace mw::io {

/// Whether the folder holds a file that ends in .tif, .tiff or .png; hidden files do not count.
[[nodiscard]] bool is_slice_folder(const std::filesystem::path& folder);

/// All these files in natural order are the slices; files of other names are not looked at.
/// REQUIRES: is_slice_folder(folder).
/// ERRORS: mw::Error(kInput) naming the file that is not like the first, or behind which one is
/// missing; or both when there are TIFF and PNG files.
[[nodiscard]] std::unique_ptr<LabelVolume> open_slice_folder(const std::filesystem::path& folder,
                                                             const OpenOptions& options);

}  // namespace mw::io
