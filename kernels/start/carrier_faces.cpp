// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Distances from samples to unit squares, in quarters of a voxel.
#include "kernels/start/carrier_faces.h"

#include <algorithm>

#include "kernels/core/face_sample.h"
#include "kernels/core/index.h"

namespace mw {
namespace {

using Quarters = std::array<std::int64_t, 3>;

Quarters quarters(Index3 voxel) {
  return {4 * voxel.x, 4 * voxel.y, 4 * voxel.z};
}

/// Squared distance from a point to the face, in squared quarters.
std::int64_t squared_distance(const Quarters& p, const VoxelFace& face) {
  const Quarters lo = quarters(face.lower);
  std::int64_t sum = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const std::int64_t from = k == face.axis ? lo[k] + 4 : lo[k];
    const std::int64_t gap = std::max<std::int64_t>({from - p[k], p[k] - (lo[k] + 4), 0});
    sum += gap * gap;
  }
  return sum;
}

std::int64_t farthest_sample(unsigned axis, const VoxelFace& to) {
  std::int64_t farthest = 0;
  for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
    Quarters p{};
    unsigned bit = 0;
    for (unsigned k = 0; k < 3; ++k) p[k] = k == axis ? 4 : 1 + 2 * (quarter >> bit++ & 1U);
    farthest = std::max(farthest, squared_distance(p, to));
  }
  return farthest;
}

}  // namespace

CarrierFaces::CarrierFaces(double max_distance) {
  const double reach = 4.0 * (std::min(max_distance, kMaxCoarseDistance) - kSampleCoveringRadius);
  for (unsigned axis = 0; axis < 3; ++axis) find_carriers(axis, std::max(reach, 0.0));
}

void CarrierFaces::find_carriers(unsigned axis, double reach) {
  std::vector<std::pair<std::int64_t, VoxelFace>> found;
  for_each_index(Box3{{-1, -1, -1}, {2, 2, 2}}, [&](Index3 lower) {
    for (unsigned other = 0; other < 3; ++other) {
      const VoxelFace face{lower, other};
      const std::int64_t distance = farthest_sample(axis, face);
      if (static_cast<double>(distance) <= reach * reach) found.emplace_back(distance, face);
    }
  });
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [distance, face] : found) {
    carriers_[axis].push_back(face);
    carried_[face.axis].push_back({Index3{0, 0, 0} - face.lower, axis});
  }
}

}  // namespace mw
