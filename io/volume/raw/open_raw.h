// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a headerless file as a volume.
#pragma once

#include <filesystem>

#include "io/file/source/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// The bytes of a file that holds such voxels, unpacked where it is gzipped: one of the right size
/// may begin with gzip's magic by chance, and is then not inflated.
[[nodiscard]] std::unique_ptr<ByteSource> open_raw_bytes(const std::filesystem::path& path,
                                                         const RawLayout& layout);

/// REQUIRES: options.raw.  Spacing and origin are the options', else 1 and 0.
/// ERRORS: mw::Error(kInput) when the layout does not match the file's size to the byte.
[[nodiscard]] std::unique_ptr<LabelVolume> open_raw(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

}  // namespace mw::io
