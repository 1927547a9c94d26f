// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From lattice positions to the coordinates that are written.
#pragma once

#include "io/mesh/mesh_sink.h"
#include "io/volume/label_volume.h"
#include "kernels/core/lattice.h"

namespace mw::engine {

/// origin + spacing * voxel corner.
[[nodiscard]] inline io::Position physical(Point p, const io::VolumeInfo& info) {
  const std::array<double, 3> corner{static_cast<double>(p.x) / kUnitsPerVoxel,
                                     static_cast<double>(p.y) / kUnitsPerVoxel,
                                     static_cast<double>(p.z) / kUnitsPerVoxel};
  io::Position out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = info.origin[i] + info.spacing[i] * corner[i];
  return out;
}

}  // namespace mw::engine
