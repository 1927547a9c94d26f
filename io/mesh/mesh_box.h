// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where the box of the volume lies that a mesh was made from.
#pragma once

#include <array>

namespace mw::io {

using Position = std::array<double, 3>;  ///< physical units

/// A box in the world: a corner and three edges from there, along x, y and z of the array.  The
/// edges are at right angles, not always along the world's axes.
struct MeshBox {
  Position origin{};
  std::array<Position, 3> edges{};

  friend bool operator==(const MeshBox&, const MeshBox&) = default;
};

}  // namespace mw::io
