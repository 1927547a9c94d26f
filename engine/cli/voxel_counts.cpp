// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume as a mesh is held against it by `info` and `stats`.
#include "engine/cli/voxel_counts.h"

#include "engine/labels/label_regions.h"

namespace mw::cli {

VoxelCounts count_voxels(const io::LabelVolume& volume) {
  VoxelCounts out;
  for (const double edge : volume.info().space.spacing) out.voxel_volume *= edge;
  for (const engine::LabelRegion& region : engine::label_regions(volume)) {
    out.voxels.emplace(region.label, region.voxels);
  }
  out.names = volume.info().names;
  return out;
}

VoxelCounts count_voxels(const VolumeRequest& request) {
  const std::unique_ptr<io::LabelVolume> opened = open(request);
  const io::PreparedInput input(*opened, request.steps);
  return count_voxels(input.volume());
}

std::optional<audit::VolumeRow> held_against(const VoxelCounts& counts, RawLabel label, Label rank,
                                             double volume) {
  const auto found = counts.voxels.find(label);
  if (found == counts.voxels.end()) return std::nullopt;
  const auto voxels = static_cast<double>(found->second);
  const double in_mesh = volume / counts.voxel_volume;
  return audit::VolumeRow{rank, found->second, in_mesh, (in_mesh - voxels) / voxels};
}

}  // namespace mw::cli
