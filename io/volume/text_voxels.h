// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxels that are written as text, made into bytes that can be read by region.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "io/file/source/byte_source.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// Reads decimal numbers between blanks or commas, x fastest, up to the end of the source, into an
/// unlinked temporary file in $TMPDIR or /tmp, least significant byte first.
/// Memory: 2 MiB.
/// ERRORS: mw::Error(kInput) naming the source and `field` where a word is no number of the type,
/// or where there are not `count` of them; kResource when the disk is full.
[[nodiscard]] std::unique_ptr<ByteSource> voxels_of_text(const ByteSource& source, VoxelType type,
                                                         std::uint64_t count,
                                                         std::string_view field);

}  // namespace mw::io
