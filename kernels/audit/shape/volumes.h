// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How well the mesh keeps the volumes of labels (promise P8), and the lattice of layered voxels.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kernels/audit/compensated_sum.h"
#include "kernels/audit/subject.h"
#include "kernels/core/lattice.h"

namespace mw::audit {

/// Labels of fewer voxels are listed but not judged: a single vertex holds a large share of them.
inline constexpr std::uint64_t kMinJudgedVoxels = 1000;

/// One label in voxels and mesh.
struct VolumeRow {
  Label label = 0;
  std::uint64_t voxels = 0;
  double volume_voxels = 0;  ///< volume in the mesh, in voxels
  double error = 0;          ///< mesh / voxels - 1
  double faces_a_voxel = 0;  ///< faces to other labels per voxel, both of the lattice
};

/// volume6 is six times the mesh's volume in cubic units of the lattice, of which a voxel has
/// 1024^3 * parts.  The error is rounded once, from the exact difference.  REQUIRES: voxels > 0.
[[nodiscard]] VolumeRow volume_row(Label label, std::uint64_t voxels, Int128 volume6,
                                   std::int64_t parts = 1);

/// How far a label may be off where `bound` is promised.  A rough label, with more than two faces
/// for five voxels, may be off by more: with a bound of 5 %, an eighth of a voxel for each face.
/// Dust, threads and plates leave no room for a smooth surface, and what they lose is what their
/// surroundings gain.
[[nodiscard]] double volume_bound(const VolumeRow& row, double bound);

/// Voxels of a label, and how many of their faces are between it and another label.
struct VoxelCount {
  std::uint64_t voxels = 0;
  std::uint64_t faces = 0;
};

/// Counts by label the voxels of `box`, and the faces in it and at its lower sides; voxels outside
/// of it are looked at only for these faces.  loaded is the box that `voxels` holds: `box` and what
/// is below it.  Faces are those of voxels cut into layers.  REQUIRES: labels < label_count.
[[nodiscard]] std::vector<VoxelCount> count_voxels(const VoxelLabels& voxels, const Box3& loaded,
                                                   const Box3& box, std::size_t label_count,
                                                   Index3 layers);

/// Figures over the labels of at least kMinJudgedVoxels.
struct VolumeSummary {
  std::uint64_t labels_measured = 0;
  double error_mean_abs = 0;
  double error_max_abs = 0;
  std::optional<VolumeRow> worst;  ///< the first with the largest error, if any was measured
};

/// Takes labels one after the other.
class VolumeMeter {
 public:
  void add(const VolumeRow& row);
  [[nodiscard]] VolumeSummary summary() const;

 private:
  VolumeSummary summary_;  ///< without the mean
  CompensatedSum sum_;
};

struct VolumeReport {
  VolumeSummary summary;
  std::vector<VolumeRow> per_label;  ///< labels of the volume, ascending
  bool exact = false;                ///< summed in whole numbers
};

/// Volumes of a mesh's labels, in both ways.
struct VolumeTally {
  std::vector<Int128> exact;            ///< see volume_row(); by label
  std::vector<CompensatedSum> rounded;  ///< voxels; by label
  bool is_exact = true;

  /// Adds another tally, whose label l is labels[l] here.
  void add(const VolumeTally& other, std::span<const Label> labels);
};

/// Measures the tets that a tile owns.  frame is that of the layers.  A tet counts with its
/// absolute volume, unless its label is none of the volume's.  The result is exact when every
/// vertex lies, up to the rounding of `origin + spacing * corner` in double, on the 1/1024-voxel
/// lattice of the frame: volumes are then sums of integers.  Other meshes are summed in double as
/// they are, which is right to some 1e-12 of a volume. REQUIRES: vertex rows in range, finite
/// coordinates, positive spacing. Memory: 24 bytes a vertex.  Deterministic.
[[nodiscard]] VolumeTally tally_volumes(const MeshTile& tile, std::size_t label_count,
                                        const Frame& frame);

/// Compares with the voxels of each label; `parts` is the number of layers in a voxel.
[[nodiscard]] VolumeReport compare_volumes(std::span<const VoxelCount> voxels,
                                           const VolumeTally& mesh, std::int64_t parts);

/// A volume as one solid with its voxels cut into layers, on a finer lattice.
struct LayeredLabels {
  Index3 shape;
  std::vector<Label> labels;

  [[nodiscard]] VoxelLabels view() const { return {.shape = shape, .labels = labels}; }
};

/// Repeats each voxel `layers` times along each axis.
/// REQUIRES: layers from 1 to kMaxLayers.  Errors: kResource above 2^20 voxels along an axis.
/// Cost: 4 bytes a layered voxel.
[[nodiscard]] LayeredLabels layered_labels(const VoxelLabels& volume, Index3 layers);

/// The frame of layered_labels().
[[nodiscard]] Frame layered_frame(const Frame& frame, Index3 layers);

}  // namespace mw::audit
