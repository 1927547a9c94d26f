// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Layers, and what can be promised on them.
#include "engine/voxel_lattice.h"

#include <algorithm>
#include <cmath>

#include "io/file/errors.h"
#include "kernels/core/face_sample.h"
#include "kernels/core/layers.h"
#include "kernels/lattice/start_quality.h"

namespace mw::engine {
namespace {

/// What ids and samples can number, and positions hold.
void check_shape(Index3 shape, Index3 layers) {
  const Index3 lattice = layered_shape(shape, layers);
  const std::int64_t longest = std::max({lattice.x, lattice.y, lattice.z});
  if (longest < kMaxSampledVoxels) return;
  const bool cut = layers != Index3{1, 1, 1};
  throw Error(ErrorKind::kInput,
              io::text("the volume has ", longest, " voxels along an axis",
                       cut ? io::text(" once they are cut into ", layers.x, " x ", layers.y, " x ",
                                      layers.z, " layers, as their spacing differs")
                           : "",
                       "; fewer than ", kMaxSampledVoxels, " can be meshed: cut it into parts",
                       cut ? ", or set --surface voxel" : ""));
}

/// Rounded down to three decimals, so that it can be promised; 0 is always kept.
double rounded_floor(double floor) {
  return std::floor(1000 * floor) / 1000;
}

/// No step makes a tet below the floor; only the start mesh could have one.
void check_floor(const io::VolumeInfo& volume, Index3 layers, const MeshSettings& settings) {
  const std::array<double, 3> spacing = layered_spacing(volume.spacing, layers);
  const double kept = least_start_ratio(Metric(spacing), largest_cell_level(settings));
  if (kept >= settings.quality_floor) return;
  const bool could_cut = layers != layers_of(volume, Surface::kSmooth);
  throw Error(
      ErrorKind::kUsage,
      io::text("quality-floor ", settings.quality_floor, " cannot be promised for voxels of ",
               spacing[0], " x ", spacing[1], " x ", spacing[2], "; --quality-floor ",
               rounded_floor(kept), " can be",
               could_cut ? ", or set --surface smooth, which cuts thick slices into layers" : ""));
}

}  // namespace

Index3 layers_of(const io::VolumeInfo& volume, Surface surface) {
  return surface == Surface::kSmooth ? mw::layers_of(volume.spacing) : Index3{1, 1, 1};
}

VoxelLattice::VoxelLattice(const io::DenseVolume& volume, Surface surface)
    : volume_(volume),
      layers_(layers_of(volume.info(), surface)),
      layered_(volume.raw(), layers_),
      labels_(layered_, volume.table()) {}

void check(const io::VolumeInfo& volume, const MeshSettings& settings) {
  check(settings);
  const Index3 layers = layers_of(volume, settings.surface);
  check_shape(volume.shape, layers);
  check_floor(volume, layers, settings);
}

}  // namespace mw::engine
