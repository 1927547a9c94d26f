// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a .npy file as a volume.
#pragma once

#include "io/file/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// Axes of the array are [z, y, x]; both C and Fortran order.  The format knows neither spacing
/// nor origin: 1 and 0.  Bytes behind the voxels are ignored, as numpy does.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] std::unique_ptr<LabelVolume> open_npy(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

}  // namespace mw::io
