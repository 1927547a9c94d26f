// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is found in a volume, or a mesh, that is looked at as a whole, as tiles together have to
// give it, and the verdict.
#pragma once

#include "kernels/audit/audit.h"

namespace mw::audit::test {

/// P1.  Rows as those of mesh_betti().
[[nodiscard]] std::vector<RegionBetti> voxel_betti(const VoxelLabels& volume,
                                                   std::size_t label_count);

/// P2, from the check "P2 input" on; if that fails, nothing else is looked at.
[[nodiscard]] ValidityReport check_validity(const AuditMesh& mesh, const VoxelLabels& volume,
                                            const Frame& frame, std::size_t label_count,
                                            const KeptLabels& kept = {});

/// P3.
[[nodiscard]] QualityReport measure_quality(const AuditMesh& mesh);

/// P4.
[[nodiscard]] DistanceReport measure_distance(const VoxelLabels& volume, std::size_t label_count,
                                              const AuditMesh& mesh, const Frame& frame,
                                              const KeptLabels& kept = {},
                                              double limit = kDistanceLimit);

/// P8.
[[nodiscard]] VolumeReport measure_volumes(const VoxelLabels& volume, std::size_t label_count,
                                           const AuditMesh& mesh, const Frame& frame,
                                           Index3 layers = {1, 1, 1});

[[nodiscard]] ShapeReport measure_shape(const AuditMesh& mesh);

/// label_count: size of the label table; the volume's labels are below it.
/// Errors: kInput for an unusable volume; whatever is wrong with the mesh is a failed check.
[[nodiscard]] AuditReport audit(const VoxelLabels& volume, std::size_t label_count,
                                const AuditMesh& mesh, const Frame& frame,
                                const AuditOptions& options = {});

/// The names of checks that failed, in their order.
[[nodiscard]] std::vector<std::string> failures(const AuditReport& report);

}  // namespace mw::audit::test
