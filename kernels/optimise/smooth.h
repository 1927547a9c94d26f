// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Vertex smoothing: moves a free vertex to where the tets of its star have better shapes.
#pragma once

#include <optional>

#include "kernels/distance/distance_guard.h"
#include "kernels/mesh/tet_mesh.h"
#include "kernels/optimise/short_edges.h"
#include "kernels/quality/star_batch.h"
#include "kernels/size/edge_limits.h"
#include "kernels/surface/flat_plane.h"
#include "kernels/surface/line_field.h"
#include "kernels/surface/surface_energy.h"
#include "kernels/surface/surface_star.h"

namespace mw {

struct SmoothOptions {
  double smooth_below = 0.8;   ///< vertices whose worst tet reaches this are left alone
  double quality_floor = 0.1;  ///< no move creates a tet below this, unless it replaces a worse one
  /// With weights and a guard, interface vertices, however good their tets, go where SurfaceEnergy
  /// and shape energy together are least; without, where shapes are best within the slack.
  std::optional<SurfaceWeights> surface;
  int newton_steps = 2;              ///< the most steps that a vertex takes in a call
  const SizeField* sizes = nullptr;  ///< limits that edges keep to; null means none
};

/// Moves vertices to where the shape energy of their stars (kernels/quality/star_batch.h) is
/// clearly lower.
///
/// Inner vertices move freely, box vertices within their planes.  Where the faces that an interface
/// vertex carries are flat (flat_plane.h), it goes to their plane and stays there, whatever shapes
/// would gain beside it: what is flat in the input is flat in the mesh, to the last bit.  Interface
/// vertices move by SurfaceEnergy as well; those with a fold at them search along the normal and
/// across it too, because Newton's steps end in the nearest minimum.  Without a surface energy they
/// go only where their quadric stays below max(present value, a quarter voxel squared per
/// accumulated plane): the slack is absolute, so it does not add up over visits.  With a guard they
/// keep the distance bound as well.
class Smoother {
 public:
  /// debts holds those of the sweep before and gets those of this sweep; null means none.
  Smoother(TetMesh& mesh, const Metric& metric, const SmoothOptions& options,
           DistanceGuard* guard = nullptr, VolumeDebts* debts = nullptr);

  /// Returns true when v moved.  REQUIRES: v free.
  /// ENSURES: all tets exactly positive; connectivity, and so topology, unchanged.
  bool smooth(LocalVertex v);

  [[nodiscard]] bool fits_interfaces() const { return guard_ != nullptr && options_.surface; }

 private:
  void collect_surface(LocalVertex v);
  [[nodiscard]] std::optional<FlatPlane> plane_to_keep(LocalVertex v);
  bool move_to(LocalVertex v, Point target);

  TetMesh& mesh_;
  const Metric& metric_;
  SmoothOptions options_;
  EdgeLimits limits_;
  DistanceGuard* guard_;
  VolumeDebts* debts_;
  StarBatch star_;
  ShortEdges short_edges_;
  InterfaceFan fan_;
  std::vector<FanTriangle> triangles_;  ///< at an interface vertex that is not fitted
  SurfaceStar surface_;                 ///< star of an interface vertex that is fitted
  SurfaceEnergy surface_energy_;
  WideFlatPlane wide_plane_;
  LineField lines_;
  CurvatureField curvature_;  ///< as it was before the first move
};

}  // namespace mw
