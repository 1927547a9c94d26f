// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where the input is flat across an axis, so that the mesh can be flat to the last bit.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "kernels/distance/distance_guard.h"
#include "kernels/distance/interface_fan.h"

namespace mw {

/// A plane across an axis.
struct FlatPlane {
  unsigned axis = 0;
  std::int32_t place = 0;  ///< coordinate along the axis, lattice units

  friend bool operator==(const FlatPlane&, const FlatPlane&) = default;
};

/// Returns the plane that contains all faces that the triangles of a fan carry, or, where they
/// carry none, the triangles themselves; nothing if there is no such plane.
[[nodiscard]] std::optional<FlatPlane> flat_plane(const TetMesh& mesh, const DistanceGuard& guard,
                                                  LocalVertex v, std::span<const FanTriangle> fan);

/// True if all vertices of a fan except its centre lie in the plane.
[[nodiscard]] bool has_ring(const FlatPlane& plane, const TetMesh& mesh,
                            std::span<const FanTriangle> fan);

/// Tests the faces that the neighbours of a vertex carry.
class WideFlatPlane {
 public:
  /// True if all faces that the fans of the neighbours carry lie in the plane.
  [[nodiscard]] bool holds(const FlatPlane& plane, const TetMesh& mesh, const DistanceGuard& guard,
                           std::span<const FanTriangle> fan);

 private:
  InterfaceFan fans_;
  std::vector<FanTriangle> fan_;
};

}  // namespace mw
