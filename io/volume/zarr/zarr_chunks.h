// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Chunks of a Zarr array, each in a file of its own or several in a shard.
#pragma once

#include <filesystem>
#include <memory>

#include "io/chunks/chunk.h"
#include "io/volume/zarr/axis_map.h"
#include "io/volume/zarr/zarr_array.h"

namespace mw::io {

/// A missing file, and a chunk that a shard does not have, are fill values: an error when those are
/// no labels.  An index of a shard is read once and kept with the last used others.
/// REQUIRES: the array is checked, and axes are its.
[[nodiscard]] std::unique_ptr<ChunkSource> zarr_chunks(const std::filesystem::path& folder,
                                                       const ZarrArray& array, const AxisMap& axes);

}  // namespace mw::io
