// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Predicts what windows cost before they are visited.
#pragma once

#include "engine/labels/boundary_faces.h"
#include "engine/march/window_order.h"
#include "engine/settings/settings.h"

namespace mw::engine {

/// The place of a march among the marches of its run.
struct MarchIndex {
  bool is_first = true;
  bool is_last = true;
};

/// The work of one march's windows in microseconds of one core, as measured for balls, grains,
/// noise, CT and EM volumes with one thread (within a factor of 1.5 of one another; other machines,
/// settings and volumes differ by factors that a run measures by itself).  A window costs the more
/// the more interfaces it holds, more again where they are dense, and most for a block that it is
/// the first to see.
class MarchWork {
 public:
  /// REQUIRES: the faces outlive this.
  MarchWork(const BoundaryFaces& faces, const WindowOrder& order, const MeshSettings& settings,
            MarchIndex position);

  [[nodiscard]] double of(Index3 window) const;
  [[nodiscard]] double of_all() const;

 private:
  [[nodiscard]] bool sees_first(Index3 window, Index3 block) const;

  const BoundaryFaces& faces_;
  WindowOrder order_;
  double per_face_;
  double per_new_face_;
  double per_new_voxel_;
  double density_factor_;
};

/// Returns the work of one of the two readings of a block for the output, in microseconds, too.
[[nodiscard]] double output_work(const BoundaryFaces& faces, const Box3& block);

}  // namespace mw::engine
