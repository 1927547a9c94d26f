// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One scale of a precomputed volume, from its `info` file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/json/json.h"
#include "io/volume/open_options.h"
#include "io/volume/precomputed/compressed_segmentation.h"
#include "io/volume/precomputed/sharding.h"

namespace mw::io {

/// Sizes in voxels.
struct PrecomputedScale {
  std::string key;        ///< folder of the chunks, relative to that of `info`
  std::string key_field;  ///< what errors call it: "scales[0].key"
  VoxelType type = VoxelType::kU8;
  Index3 shape;
  Index3 offset;  ///< of the first voxel in the names of chunks
  Index3 chunk;   ///< not beyond the shape
  VolumeSpace space;
  std::optional<Index3> block;       ///< of compressed_segmentation; empty: raw
  std::optional<Sharding> sharding;  ///< empty: a file for each chunk
};

/// The scale that the options ask for: by its key (dataset), by its number (scale), or the first.
/// Checks all numbers, and bounds what chunks may take.
/// ERRORS: mw::Error(kInput) naming file and field; kUsage when there is no such scale.
[[nodiscard]] PrecomputedScale parse_precomputed_info(const Json& info, std::string_view file,
                                                      const OpenOptions& options);

/// Chunks along each axis.
[[nodiscard]] Index3 chunk_grid(const PrecomputedScale& scale);

}  // namespace mw::io
