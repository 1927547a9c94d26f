// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a Neuroglancer precomputed volume.
#pragma once

#include <filesystem>
#include <memory>

#include "io/volume/open_options.h"

namespace mw::io {

/// Whether the folder has an `info` file.
[[nodiscard]] bool is_precomputed(const std::filesystem::path& folder);

/// Chunks raw or in compressed_segmentation, in files of their own or in shards, each also gzipped;
/// what is not there has label 0.  Coordinates are in nm.  options.scale or options.dataset (a key)
/// chooses among the scales.
/// ERRORS: mw::Error(kInput) naming file and field; kUsage when there is no such scale.
[[nodiscard]] std::unique_ptr<LabelVolume> open_precomputed(const std::filesystem::path& folder,
                                                            const OpenOptions& options);

}  // namespace mw::io
