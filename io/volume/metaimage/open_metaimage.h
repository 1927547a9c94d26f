// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a MetaImage file as a volume.
#pragma once

#include "io/file/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// Whether the voxels follow the header, or are in one or many files beside it or in folders below,
/// as source.name() tells where it is.
/// Compressed voxels are inflated into a temporary file.  Bytes behind the voxels are ignored.
/// ERRORS: mw::Error(kInput) naming file and field; kResource when the disk is full.
[[nodiscard]] std::unique_ptr<LabelVolume> open_metaimage(std::unique_ptr<ByteSource> source,
                                                          const OpenOptions& options);

}  // namespace mw::io
