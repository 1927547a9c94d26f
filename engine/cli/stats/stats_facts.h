// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh stats` tells of a mesh, and of the volume that it was made from.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "engine/cli/mesh_stats.h"
#include "engine/cli/volume_options.h"
#include "engine/cli/voxel_counts.h"

namespace mw::cli {

/// What the volume says of what the mesh has.
struct VolumeSide {
  VoxelCounts counts;
  /// Of faces of voxels, by contact, the smaller label first; square physical units.
  std::map<std::pair<RawLabel, RawLabel>, double> areas;
};

/// Opens the volume, does its steps and reads it twice.  ERRORS: those of open() and of reading.
[[nodiscard]] VolumeSide look_at_volume(const VolumeRequest& request);

/// Everything that is told, by rank of label.
struct StatsFacts {
  const io::LabelTable& table;
  io::LabelNames names;
  MeshStats mesh;
  std::optional<VolumeSide> volume;
};

/// A contact of the mesh, the volume, or both.
struct Contact {
  RawLabel first = 0;
  RawLabel second = 0;
  std::uint64_t triangles = 0;
  double area = 0;                   ///< square physical units
  std::optional<double> voxel_area;  ///< empty without a volume
};

/// Those of the mesh, then those that only the voxels have between labels of the mesh.
[[nodiscard]] std::vector<Contact> contacts_of(const StatsFacts& facts);

/// The label in the volume; empty without a volume, and for a label that it does not have.
[[nodiscard]] std::optional<audit::VolumeRow> voxels_of(const StatsFacts& facts, Label rank);

}  // namespace mw::cli
