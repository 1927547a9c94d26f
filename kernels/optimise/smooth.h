// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Vertex smoothing: moves a free vertex to where the tets of its star have better shapes.
#pragma once

#include "kernels/distance/distance_guard.h"
#include "kernels/mesh/tet_mesh.h"
#include "kernels/quality/star_batch.h"

namespace mw {

struct SmoothOptions {
  double smooth_below = 0.8;   ///< vertices whose worst tet reaches this are left alone
  double quality_floor = 0.1;  ///< no move creates a tet below, unless it replaces a worse one
};

/// Moves vertices to where the shape energy of their stars (kernels/quality/star_batch.h) is
/// clearly lower.
///
/// Inner vertices move freely, box vertices within their planes, interface vertices only where
/// their quadric stays below max(present value, a quarter voxel squared per accumulated plane): the
/// slack is absolute, so it does not add up over visits.  With a guard they keep the distance bound
/// as well.
class Smoother {
 public:
  Smoother(TetMesh& mesh, const Metric& metric, const SmoothOptions& options,
           DistanceGuard* guard = nullptr)
      : mesh_(mesh), metric_(metric), options_(options), guard_(guard) {}

  /// REQUIRES: v free.  ENSURES: all tets exactly positive; connectivity unchanged, so topology is.
  /// Returns true when v moved.
  bool smooth(LocalVertex v);

 private:
  TetMesh& mesh_;
  const Metric& metric_;
  SmoothOptions options_;
  DistanceGuard* guard_;
  StarBatch star_;
};

}  // namespace mw
