// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The lattice that a volume is meshed on: its voxels, cut into layers where slices are thick.
#pragma once

#include <string>

#include "engine/settings/settings.h"
#include "io/labels/label_table.h"
#include "io/labels/repeated_volume.h"

namespace mw::engine {

/// Returns the least size of edges that the marches can keep: the diagonal of a voxel of the
/// lattice is SizeRules::kContracted times as long.
[[nodiscard]] double least_size(const io::VolumeInfo& volume);

/// Checks that a mesh of the volume can be written in double.
/// ERRORS: kInput when coordinates are too large or too small, or too near each other for their
/// size.
void check_coordinates(const io::VolumeInfo& volume);

/// Returns the edge of a cube that has the volume of a voxel of the lattice.
/// REQUIRES: check_coordinates() passes.
[[nodiscard]] double voxel_edge(const io::VolumeInfo& volume);

/// Returns a size rounded up to three digits, so that the size a user is told can be kept.
[[nodiscard]] double told_size(double size);

/// Returns a line about voxels that are cut into more than 20 layers, as where a wrong spacing
/// makes them thick; else nothing.
[[nodiscard]] std::string many_layers_text(const io::VolumeInfo& volume);

/// A volume and the lattice that it is meshed on.  The volume must outlive it.
class VoxelLattice {
 public:
  /// periodic: MeshSettings::periodic.
  explicit VoxelLattice(const io::DenseVolume& volume, unsigned periodic = 0);
  VoxelLattice(const VoxelLattice&) = delete;
  VoxelLattice& operator=(const VoxelLattice&) = delete;

  [[nodiscard]] const io::DenseVolume& volume() const { return volume_; }
  /// Returns the lattice's labels: each voxel has that of the volume's voxel in which it lies.
  [[nodiscard]] const io::DenseVolume& labels() const { return labels_; }
  [[nodiscard]] const io::VolumeInfo& info() const { return labels_.info(); }
  [[nodiscard]] Index3 layers() const { return layers_; }

 private:
  io::DenseVolume volume_;
  Index3 layers_;
  io::LayeredVolume layered_;
  io::DenseVolume labels_;
};

/// Checks before any work that a volume fits the settings of a run.
/// ERRORS: those of check(settings); kInput when the lattice has too many
///         voxels along an axis or coordinates are too large or too small for it;
///         kUsage when the quality floor cannot be kept at this spacing, with the floor that can,
///         or when a size is below least_size().
/// REQUIRES: sizes are in physical units.
void check(const io::VolumeInfo& volume, const MeshSettings& settings);

/// Checks that a volume's labels fit the settings of a run.
/// ERRORS: kUsage when a size is given for a label that the volume does not have.
void check(const io::LabelTable& labels, const MeshSettings& settings);

}  // namespace mw::engine
