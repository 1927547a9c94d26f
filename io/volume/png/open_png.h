// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens PNG slices as a volume.
#pragma once

#include <filesystem>
#include <vector>

#include "io/file/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// One slice, which is read through its name; otherwise as open_png_slices().
[[nodiscard]] std::unique_ptr<LabelVolume> open_png(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

/// Files are slices, in this order; rows go along x, from the top down along y.  Spacing is 1, the
/// first corner at 0.  REQUIRES: at least one file.
/// Cost: a slice is unpacked as one.
/// ERRORS: mw::Error(kInput) naming the file that is no labels, or not like the first.
[[nodiscard]] std::unique_ptr<LabelVolume> open_png_slices(std::vector<std::filesystem::path> files,
                                                           const OpenOptions& options);

}  // namespace mw::io
