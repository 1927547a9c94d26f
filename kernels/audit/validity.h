// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Is a mesh a conforming partition of the box into labelled tets (promise P2)?
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/audit/check.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// What check_validity found.  The counts are those that the checks' details name.
struct ValidityReport {
  std::vector<Check> checks;
  /// Sign that all tets share, which is to be 1; 0 when they do not, or when the input could not be
  /// read as a mesh.
  int orientation = 0;
  std::uint64_t positive_tets = 0;
  std::uint64_t negative_tets = 0;
  std::uint64_t flat_tets = 0;        ///< exact volume 0, repeated vertices included
  std::uint64_t exact_decisions = 0;  ///< tets that the floating point filter left undecided
  std::uint64_t unused_vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t box_faces = 0;
  double volume = 0;  ///< sum over all tets, cubic physical units
  double box_volume = 0;
  std::vector<double> label_volumes;  ///< label_count values, then all tets of unknown label

  [[nodiscard]] bool passed() const;
};

/// P2.  The checks, in order: "P2 input" (rows in range, finite numbers; if it fails, nothing else
/// is looked at), "P2 orientation" (all strictly positive, exactly), "P2 vertices" (no two at one
/// position, each in a tet), "P2 tets" (none twice), "P2 faces" (two tets on opposite sides, or one
/// and on a plane of the box), "P2 box" (all vertices inside, all corners there), "P2 volume" (sum
/// equals the box's to 1e-9, and the rounding of coordinates), "P2 labels" (the mesh's are the
/// volume's).  Together they prove a partition: faces that pair up on opposite sides cover the
/// inside of the box equally often everywhere, and the volume says once. Of a mesh from which
/// labels were left out, triangles of one tet may be anywhere, corners may be missing, the volume
/// is at most the box's, and the labels are those that are kept.  What the volume proves is then
/// sampled: "P2 overlap" (check_overlap). Planes and corners are those of the frame in double, to
/// 1e-9 of the box's extent, since other tools round (box_planes.h). REQUIRES: labels of the volume
/// < label_count.  Memory: 17 bytes a tet, 50 a vertex. Deterministic.
[[nodiscard]] ValidityReport check_validity(const AuditMesh& mesh, const VoxelLabels& volume,
                                            const Frame& frame, std::size_t label_count,
                                            const KeptLabels& kept = {});

}  // namespace mw::audit
