// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an NRRD file as a volume.
#pragma once

#include <filesystem>

#include "io/file/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// A detached `data file` is looked for relative to the folder of path.  Bytes behind the voxels
/// are ignored.  ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] std::unique_ptr<LabelVolume> open_nrrd(std::unique_ptr<ByteSource> source,
                                                     const std::filesystem::path& path,
                                                     const OpenOptions& options);

}  // namespace mw::io
