// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an INRIMAGE-4 file (.inr), which CGAL and its friends exchange, as a volume.
#pragma once

#include "io/file/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

[[nodiscard]] bool has_inr_magic(std::span<const std::byte> head);

/// VX, VY, VZ are the spacing, TX, TY, TZ the first corner (absent: 1 and 0).  Bytes behind the
/// voxels are ignored.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] std::unique_ptr<LabelVolume> open_inr(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

}  // namespace mw::io
