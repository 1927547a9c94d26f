// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a MetaImage file as a volume, whose slices may be files of their own.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/source/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// Whether a value of ElementDataFile names many files: "LIST", or a pattern with %.
[[nodiscard]] bool names_many_files(std::string_view data_file);

/// Names of `count` files, first slice first: the lines behind the header for "LIST", else those of
/// "PATTERN FIRST LAST STEP" (FIRST 1 and STEP 1 where they are missing), where PATTERN has one %d,
/// which may have a width, as in %03d.
/// ERRORS: mw::Error(kInput) naming the file and its field.
[[nodiscard]] std::vector<std::string> slice_names(std::string_view data_file,
                                                   std::string_view behind_header,
                                                   std::int64_t count, std::string_view file);

/// Whether the voxels follow the header, or are in one or many files beside it or in folders below,
/// as source.name() tells where it is.
/// Compressed voxels are inflated into a temporary file.  Bytes behind the voxels are ignored.
/// ERRORS: mw::Error(kInput) naming file and field; kResource when the disk is full.
[[nodiscard]] std::unique_ptr<LabelVolume> open_metaimage(std::unique_ptr<ByteSource> source,
                                                          const OpenOptions& options);

}  // namespace mw::io
