// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an array of an N5 container.
#pragma once

#include <filesystem>
#include <memory>

#include "io/volume/open_options.h"

namespace mw::io {

/// Whether the folder has an attributes.json, levels of a pyramid, or a name with .n5.
[[nodiscard]] bool is_n5(const std::filesystem::path& folder);

/// Blocks raw or packed by gzip, zlib, bzip2, xz, lz4, blosc or zstd; what is not there has label
/// 0. See find_n5_array for which array, and n5_space for its place. ERRORS: mw::Error(kInput)
/// naming file and field; kUsage when there is no such dataset or level.
[[nodiscard]] std::unique_ptr<LabelVolume> open_n5(const std::filesystem::path& folder,
                                                   const OpenOptions& options);

}  // namespace mw::io
