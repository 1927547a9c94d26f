// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From lattice positions to the coordinates that are written.
#pragma once

#include "io/mesh/mesh_sink.h"
#include "io/volume/volume_space.h"
#include "kernels/core/lattice.h"

namespace mw::engine {

/// Where a point of a lattice that cuts a volume's voxels into layers is in the volume's space. One
/// division a coordinate, so that corners of the volume's voxels stay whole numbers.
[[nodiscard]] inline io::Position physical(Point p, const io::VolumeSpace& space,
                                           Index3 layers = {1, 1, 1}) {
  const auto in_voxels = [](std::int32_t units, std::int64_t of_voxel) {
    return static_cast<double>(units) / static_cast<double>(of_voxel * kUnitsPerVoxel);
  };
  return to_world(space,
                  {in_voxels(p.x, layers.x), in_voxels(p.y, layers.y), in_voxels(p.z, layers.z)});
}

}  // namespace mw::engine
