// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How far the mesh's label boundaries are from the input's, both ways (promise P4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/audit/subject.h"

namespace mw::audit {

/// From this many interface faces on, a voxel face has five samples instead of nine.
inline constexpr std::size_t kManyInterfaceFaces = 4'000'000;

/// Covering radius of the samples on the mesh's triangles, in voxels.
inline constexpr double kMeshCoveringRadius = 0.25;

/// Distances in voxels.  Every one is the largest over samples, hence a lower bound of the true
/// one-sided Hausdorff distance, which is larger by no more than the covering radius of the side
/// that was sampled (distance to a set changes by no more than one walks).
struct DistanceReport {
  /// A label with an interface on one side only has infinite figures, in both directions.
  struct PerLabel {
    /// kUnknown for all labels of the mesh that the volume does not have, kLeftOut for the space
    /// that has no tets because labels were left out.
    Label label = 0;
    double input_to_mesh_max = 0;
    double input_to_mesh_mean = 0;
    double mesh_to_input_max = 0;
    double mesh_to_input_mean = 0;

    [[nodiscard]] double max() const;
    [[nodiscard]] bool is_finite() const;
  };

  double max_voxels = 0;   ///< over all labels and both directions
  double mean_voxels = 0;  ///< the same, by area: each face and triangle counts once a label
  std::vector<PerLabel> per_label;  ///< labels with an interface on some side, ascending
  std::vector<Label> only_in_volume;
  std::vector<Label> only_in_mesh;
  std::uint64_t voxel_faces = 0;
  std::uint64_t mesh_triangles = 0;
  std::uint32_t samples_a_face = 0;
  double input_covering_radius = 0;
  double mesh_covering_radius = 0;

  [[nodiscard]] bool is_finite() const { return only_in_volume.empty() && only_in_mesh.empty(); }
  /// The first label with the largest finite distance; nullptr when no label has one.
  [[nodiscard]] const PerLabel* farthest() const;
};

/// P4.  A label's boundary are the voxel faces, or the triangles, between it and another label of
/// the volume; the box is none.  Lengths are in voxels along each axis: (p - origin) / spacing.
/// Input to mesh: samples on every voxel face of a label's boundary (corners, middles of edges,
/// centre; corners and centre from kManyInterfaceFaces on), each to the nearest triangle of that
/// label's boundary.  Mesh to input: samples that cover each triangle to kMeshCoveringRadius, each
/// to the nearest voxel face.  Means are by area.
/// Of a mesh from which labels were left out, boundaries of kept labels are also its triangles of
/// one tet that are not on the box.  Those are samples of kLeftOut as well, held against the faces
/// of all labels that were left out: no such triangle may be where none of these labels is.  The
/// other way round nothing is known of them.
/// REQUIRES: as voxel_betti and mesh_betti; finite vertices; positive spacing.
/// Errors: kInput when the mesh is none, kResource above 2^20 voxels along an axis.
/// Cost: two passes over the voxels, O(log) a sample; some 80 bytes a voxel face and 150 a triangle
/// of the interface.  A mesh with more interface than any valid one (200 million samples) is
/// sampled more coarsely, as mesh_covering_radius then says.  Deterministic, one thread.
[[nodiscard]] DistanceReport measure_distance(const VoxelLabels& volume, std::size_t label_count,
                                              const AuditMesh& mesh, const Frame& frame,
                                              const KeptLabels& kept = {});

/// The covering radii, in words: how much larger the true distances may be.
[[nodiscard]] std::string sampling_text(const DistanceReport& report);

}  // namespace mw::audit
