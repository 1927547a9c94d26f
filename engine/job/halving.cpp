// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/halving.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/labels/voxel_lattice.h"
#include "io/file/errors.h"
#include "kernels/distance/distance_guard.h"

namespace mw::engine {
namespace {

/// The share of the bound on the distance that the marches keep to where tets are cut afterwards.
constexpr double kMarchesShare = 0.8;

}  // namespace

int halvings_of(const io::VolumeInfo& volume, const MeshJob& job, double in_image) {
  const SizeSettings& sizes = job.settings.sizes;
  if (!sizes.rules.any() || sizes.count > 0) return 0;
  const double kept = least_size(volume), listed = sizes.rules.least();
  if (std::ldexp(listed, io::kMostHalvings) < kept) {
    io::fail_usage("--size ", listed,
                   " is too small: the marches make edges as long as the diagonals of "
                   "voxels, and tets are cut ",
                   io::kMostHalvings, " times at most; ",
                   told_size(std::ldexp(kept, -io::kMostHalvings)), " can be kept");
  }
  const double least = std::min(listed, in_image);
  int times = 0;
  while (times < io::kMostHalvings && std::ldexp(least, times) < kept) ++times;
  return times;
}

MeshSettings before_halvings(MeshSettings settings, int times) {
  if (times == 0) return settings;
  const int edges = 1 << times;  // into which an edge is cut, one behind the other
  settings.sizes.rules = settings.sizes.rules.scaled(edges);
  settings.sizes.across = (settings.sizes.across + edges - 1) / edges;
  if (settings.surface == Surface::kSmooth && settings.max_distance) {
    settings.max_distance =
        std::min(*settings.max_distance,
                 std::max(DistanceGuard::min_distance(), kMarchesShare * *settings.max_distance));
  }
  return settings;
}

CutTask cut_task(int times, const MeshJob& job, const io::VolumeInfo& volume) {
  CutTask out{.times = times};
  const MeshSettings& asked = job.settings;
  if (times == 0 || asked.surface != Surface::kSmooth) return out;
  out.curves = {.most_move = std::numeric_limits<double>::infinity(),
                .max_distance = asked.max_distance};
  if (asked.max_distance) {
    // Each of the cuts may use its part of what the marches left.
    const double left = *asked.max_distance - *before_halvings(asked, times).max_distance;
    const auto& spacing = volume.space.spacing;
    const auto voxel = layered_spacing(spacing, layers_of(spacing, volume.shape, asked.periodic));
    out.curves->most_move = left / times * *std::min_element(voxel.begin(), voxel.end());
  }
  return out;
}

}  // namespace mw::engine
