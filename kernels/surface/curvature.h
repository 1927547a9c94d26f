// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How much interfaces curve at their vertices.
#pragma once

#include <optional>
#include <vector>

#include "kernels/surface/surface_star.h"

namespace mw {

/// Mean curvature (twice its usual value, 1 / length) of interfaces of a window, at the vertices
/// where it can be told: free ones between two labels, off the box.  Positive where the smaller
/// label is convex.
class CurvatureField {
 public:
  /// Of all vertices, as they are now.
  void measure(const TetMesh& mesh, const Metric& metric);

  [[nodiscard]] std::optional<double> at(LocalVertex v) const {
    if (v >= known_.size() || known_[v] == 0) return std::nullopt;
    return curvature_[v];
  }

 private:
  SurfaceStar star_;
  std::vector<std::uint8_t> known_;
  std::vector<double> curvature_;
};

/// The gradient of the area of the star's triangles.
[[nodiscard]] Vec3 area_gradient(const SurfaceStar& star);

}  // namespace mw
