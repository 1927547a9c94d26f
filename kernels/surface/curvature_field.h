// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How much the interfaces of a window curve at their vertices.
#pragma once

#include <optional>
#include <vector>

#include "kernels/surface/surface_star.h"

namespace mw {

/// Mean curvature of interfaces (twice its usual value, 1 / length), where it can be told: at free
/// vertices between two labels, off the box.  Positive where the smaller label is convex.
class CurvatureField {
 public:
  /// Of all vertices at once, as they are now.
  void measure(const TetMesh& mesh, const Metric& metric);

  [[nodiscard]] std::optional<double> at(LocalVertex v) const;

 private:
  SurfaceStar star_;
  std::vector<double> curvature_;
};

}  // namespace mw
