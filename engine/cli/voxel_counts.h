// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume as a mesh is held against it by `info` and `stats`.
#pragma once

#include <optional>
#include <unordered_map>

#include "engine/cli/volume_options.h"
#include "io/names/label_names.h"
#include "kernels/audit/volumes.h"

namespace mw::cli {

struct VoxelCounts {
  std::unordered_map<RawLabel, std::uint64_t> voxels;
  double voxel_volume = 1;  ///< cubic physical units
  io::LabelNames names;
};

/// One pass over the volume.
[[nodiscard]] VoxelCounts count_voxels(const io::LabelVolume& volume);
/// Opens it first, and does its steps.
[[nodiscard]] VoxelCounts count_voxels(const VolumeRequest& request);

/// A label of the mesh, of this volume, in the volume, if it is there.  rank: its dense label.
[[nodiscard]] std::optional<audit::VolumeRow> held_against(const VoxelCounts& counts,
                                                           RawLabel label, Label rank,
                                                           double volume);

}  // namespace mw::cli
