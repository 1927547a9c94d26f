// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a labelled volume of any format that is read here.
#pragma once

#include <filesystem>

#include "io/volume/open_options.h"

namespace mw::io {

/// Tells the format of a file by content, then by extension, whether it is gzipped or not, and that
/// of a folder by what is in it; raw when options.raw is given.  The numbers of the options are
/// checked like the file's.
/// ERRORS: mw::Error(kInput) naming file, field, reason and way out; kResource when a gzipped
/// file does not fit into $TMPDIR; kUsage when the options make no sense.
[[nodiscard]] std::unique_ptr<LabelVolume> open_volume(const std::filesystem::path& path,
                                                       const OpenOptions& options = {});

}  // namespace mw::io
