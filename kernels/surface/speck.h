// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The volumes of parts of a few voxels, which their voxels tell exactly.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernels/core/label.h"
#include "kernels/core/metric.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// The volume of a part of a label, as a share of that of its voxels, when a vertex of it moves.
struct SpeckVolume {
  double share = 1.0;         ///< at present
  Vec3 slope = Vec3::Zero();  ///< what a move adds to it, 1 / metric unit
};

/// Measures parts of labels: tets that hang together by faces, and voxels that do.  Topology keeps
/// their number (kernels/topology/README.md), so a part of the mesh is the nearest one of the
/// voxels.
class SpeckMeasure {
 public:
  /// Measures the parts that a label has at v, until one has more than a few tets.  Leaves out
  /// those whose voxels voxels_of_part() does not find, and those of more than three.
  /// REQUIRES: v free.  The span is valid until the next call.
  [[nodiscard]] std::span<const SpeckVolume> at(const TetMesh& mesh, const Metric& metric,
                                                LocalVertex v, Label label, const LabelBox& labels);

 private:
  bool collect_part(const TetMesh& mesh, const LocalTet& first);
  [[nodiscard]] std::optional<SpeckVolume> measure(const TetMesh& mesh, const Metric& metric,
                                                   LocalVertex v, const LabelBox& labels) const;

  std::vector<LocalTet> part_;  ///< tets of a part, as they are found
  std::vector<LocalTet> seen_;  ///< tets of all parts
  std::vector<SpeckVolume> found_;
};

}  // namespace mw
