// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an NRRD file as a volume.
#pragma once

#include "io/file/source/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// A detached `data file` is looked for relative to the
/// folder of source.name().  Bytes behind the voxels
/// are ignored.  ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] std::unique_ptr<LabelVolume> open_nrrd(std::unique_ptr<ByteSource> source,
                                                     const OpenOptions& options);

}  // namespace mw::io
