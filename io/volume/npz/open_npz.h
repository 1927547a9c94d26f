// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an array of a NumPy .npz archive as a volume.
#pragma once

#include "io/file/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// The array NAME or NAME.npy that options.dataset names, else the only one; see open_npy.
/// Deflated arrays are inflated into a temporary file.
/// ERRORS: mw::Error(kInput) naming file, member and field, also when the archive's checksum is
/// another; kResource when the disk is full.
/// Cost: the array is read once, for its checksum.
[[nodiscard]] std::unique_ptr<LabelVolume> open_npz(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

}  // namespace mw::io
