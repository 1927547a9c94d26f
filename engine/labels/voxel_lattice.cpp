// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Layers of voxels, and checks of what can be promised on them.
#include "engine/labels/voxel_lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/file/errors.h"
#include "kernels/core/assert.h"
#include "kernels/core/elementary.h"
#include "kernels/core/face_sample.h"
#include "kernels/core/lattice.h"
#include "kernels/start/cells/cell_template.h"

namespace mw::engine {
namespace {

/// Checks that ids and samples can number the lattice, and that positions can hold its coordinates.
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
                       "; fewer than ", kMaxSampledVoxels,
                       " can be meshed at once: mesh parts of it with --crop, or slices of an "
                       "array"));
}

/// Returns the quality floor that the start mesh keeps.
double kept_floor(const io::VolumeInfo& volume, const MeshSettings& settings) {
  const Index3 layers = layers_of(volume.space.spacing);
  const Metric metric(layered_spacing(volume.space.spacing, layers));
  return min_start_ratio(metric, largest_cell_level(settings));
}

/// Returns another setting under which the floor can be promised, in words, if there is one.
std::string way_out(const io::VolumeInfo& volume, const MeshSettings& settings) {
  MeshSettings dense = settings;
  dense.start = StartMesh::kDense;
  return kept_floor(volume, dense) >= settings.quality_floor ? ", or set --start dense" : "";
}

/// No step makes a tet below the floor; only the start mesh could have one.
void check_floor(const io::VolumeInfo& volume, const MeshSettings& settings) {
  const double kept = kept_floor(volume, settings);
  if (kept >= settings.quality_floor) return;
  // It is rounded down, so that the floor a user is told can be promised.
  const double told = std::floor(1000 * kept) / 1000;
  const std::array<double, 3> voxel =
      layered_spacing(volume.space.spacing, layers_of(volume.space.spacing));
  io::fail_usage("--quality-floor ", settings.quality_floor, " cannot be promised for voxels of ",
                 voxel[0], " x ", voxel[1], " x ", voxel[2], "; --quality-floor ", told, " can be",
                 way_out(volume, settings));
}

/// Start meshes have edges as long as the diagonal of a voxel, and no step cuts an edge.  With a
/// count sizes are weights, and the factor that is found for them keeps to that.
void check_sizes(const io::VolumeInfo& volume, const MeshSettings& settings) {
  MW_ASSERT(!settings.sizes.rules.in_voxels);
  if (!settings.sizes.rules.any() || settings.sizes.count > 0) return;
  const double least = settings.sizes.rules.least(), kept = least_size(volume);
  if (least >= kept) return;
  io::fail_usage("--size ", least,
                 " is too small: the finest start mesh has the diagonals of voxels; ",
                 told_size(kept), " can be kept");
}

/// Returns the largest absolute coordinate of the box.
double farthest_coordinate(const io::VolumeInfo& volume) {
  double farthest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const auto end = [&](int axis, std::int64_t voxels) {
      return (corner >> axis & 1) != 0 ? static_cast<double>(voxels) : 0.0;
    };
    const io::Vector3 position = to_world(
        volume.space, {end(0, volume.shape.x), end(1, volume.shape.y), end(2, volume.shape.z)});
    // A NaN stays, whatever comes behind it.
    for (const double x : position) farthest = std::abs(x) <= farthest ? farthest : std::abs(x);
  }
  return farthest;
}

}  // namespace

double least_size(const io::VolumeInfo& volume) {
  const auto [x, y, z] = layered_spacing(volume.space.spacing, layers_of(volume.space.spacing));
  return std::sqrt(x * x + y * y + z * z) / SizeRules::kContracted;
}

void check_coordinates(const io::VolumeInfo& volume) {
  // Points of the lattice must stay far enough apart in double for the shapes of tets between them,
  // and products of three lengths must be finite and not 0.
  constexpr double kSmallest = 1e-30;
  constexpr double kLargest = 1e30;
  constexpr double kUnitsInLastPlace = 256;
  const double farthest = farthest_coordinate(volume);
  const auto voxel = layered_spacing(volume.space.spacing, layers_of(volume.space.spacing));
  const double min = std::min({voxel[0], voxel[1], voxel[2]});
  if (!(farthest <= kLargest) || min < kSmallest) {
    throw Error(ErrorKind::kInput,
                io::text("spacing and origin give coordinates up to ", farthest, " and voxels of ",
                         min, "; they can be from ", kSmallest, " to ", kLargest,
                         ": set --spacing and --origin, or another unit"));
  }
  const double step = min / static_cast<double>(kUnitsPerVoxel);
  const double max = step / (kUnitsInLastPlace * std::numeric_limits<double>::epsilon());
  if (farthest <= max) return;
  throw Error(ErrorKind::kInput, io::text("coordinates reach ", farthest,
                                          ", where numbers are too far apart for voxels of ", min,
                                          "; with these they can reach ", max,
                                          ": set --origin nearer to 0, or a larger --spacing"));
}

double voxel_edge(const io::VolumeInfo& volume) {
  const auto [x, y, z] = layered_spacing(volume.space.spacing, layers_of(volume.space.spacing));
  return cube_root(x * y * z);
}

double told_size(double size) {
  const double scale = 100 / power_of_ten_below(size);
  return std::ceil(scale * size) / scale;
}

std::string many_layers_text(const io::VolumeInfo& volume) {
  constexpr std::int64_t kMany = 20;
  const std::array<double, 3>& s = volume.space.spacing;
  const Index3 layers = layers_of(s);
  if (std::max({layers.x, layers.y, layers.z}) <= kMany) return {};
  return io::text("voxels of ", s[0], " x ", s[1], " x ", s[2], " are cut into ", layers.x, " x ",
                  layers.y, " x ", layers.z,
                  " layers, and each layer is meshed as a voxel is; --spacing sets another spacing "
                  "if this one is wrong");
}

VoxelLattice::VoxelLattice(const io::DenseVolume& volume, unsigned periodic)
    : volume_(volume),
      layers_(layers_of(volume.info().space.spacing, volume.info().shape, periodic)),
      layered_(volume.raw(), layers_),
      labels_(layered_, volume.table()) {}

void check(const io::VolumeInfo& volume, const MeshSettings& settings) {
  check(settings);
  check_shape(volume.shape, layers_of(volume.space.spacing, volume.shape, settings.periodic));
  check_coordinates(volume);
  check_floor(volume, settings);
  check_sizes(volume, settings);
}

void check(const io::LabelTable& labels, const MeshSettings& settings) {
  const auto require = [&](RawLabel label) {
    if (labels.contains(label)) return;
    const std::string name = labels.is_signed() ? std::to_string(static_cast<std::int64_t>(label))
                                                : std::to_string(label);
    io::fail_usage("--size: the volume has no label " + name);
  };
  const SizeRules& rules = settings.sizes.rules;
  for (const LabelSize& s : rules.labels) require(s.label);
  for (const InterfaceSize& s : rules.interfaces) {
    if (s.low) require(*s.low);
    if (s.high) require(*s.high);
  }
}

}  // namespace mw::engine
