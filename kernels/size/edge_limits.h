// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Refuses edges that a SizeField does not allow.
#pragma once

#include "kernels/mesh/tet_mesh.h"
#include "kernels/size/size_field.h"

namespace mw {

/// Tells whether changes of a mesh keep its edges within limits.  No edge of a start mesh is too
/// long, so it is enough to refuse new ones.  Without a field everything is allowed, at no cost.
class EdgeLimits {
 public:
  /// Keeps references.  sizes is null, or a field for which limits() is true.
  EdgeLimits(const TetMesh& mesh, const Metric& metric, const SizeField* sizes)
      : mesh_(mesh), metric_(metric), sizes_(sizes) {}
  /// The limits of moves and flips, which are SizeField::stretch() times as long.
  [[nodiscard]] static EdgeLimits of_moves(const TetMesh& mesh, const Metric& metric,
                                           const SizeField* sizes) {
    EdgeLimits out(mesh, metric, sizes);
    if (sizes != nullptr) out.stretch_ = sizes->stretch();
    return out;
  }

  [[nodiscard]] bool any() const { return sizes_ != nullptr; }

  /// Would the edges of v's tets at v keep to the limits if v were at x?  Tets that have the vertex
  /// `without` do not count; where that is v itself, all count.
  [[nodiscard]] bool allow_star(LocalVertex v, LocalVertex without, Point x) const {
    return sizes_ == nullptr || star_keeps(v, without, x);
  }
  /// Do all edges of a tet that could be made keep to the limits?
  [[nodiscard]] bool allow_tet(const LocalTet& tet) const {
    return sizes_ == nullptr || tet_keeps(tet);
  }

  /// Is an edge so short that a longer one is asked there?  False where no size is asked of the
  /// labels around it and limits only come from places farther away.  REQUIRES: any(); both
  /// alive.
  [[nodiscard]] bool is_short(LocalVertex v, LocalVertex w) const;

 private:
  [[nodiscard]] bool star_keeps(LocalVertex v, LocalVertex without, Point x) const;
  [[nodiscard]] bool tet_keeps(const LocalTet& tet) const;
  [[nodiscard]] bool is_within(Point a, Point b, double limit) const;

  const TetMesh& mesh_;
  const Metric& metric_;
  const SizeField* sizes_;
  double stretch_ = 1.0;
};

}  // namespace mw
