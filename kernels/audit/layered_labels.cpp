// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Repetition, voxel by voxel.
#include "kernels/audit/layered_labels.h"

#include <algorithm>
#include <string>

#include "kernels/core/error.h"
#include "kernels/core/layers.h"

namespace mw::audit {
namespace {

void check_shape(Index3 shape) {
  constexpr std::int64_t kMaxVoxels = std::int64_t{1} << 20;
  const std::int64_t longest = std::max({shape.x, shape.y, shape.z});
  if (longest <= kMaxVoxels) return;
  throw Error(ErrorKind::kResource, "distances: thick slices would be cut into " +
                                        std::to_string(longest) + " layers along an axis, above " +
                                        std::to_string(kMaxVoxels));
}

}  // namespace

LayeredLabels layered_labels(const VoxelLabels& volume, Index3 layers) {
  LayeredLabels out{layered_shape(volume.shape, layers), {}};
  check_shape(out.shape);
  out.labels.reserve(static_cast<std::size_t>(out.shape.product()));
  const Box3 all{{0, 0, 0}, volume.shape};
  for (std::int64_t z = 0; z < out.shape.z; ++z) {
    for (std::int64_t y = 0; y < out.shape.y; ++y) {
      const auto row = volume.labels.begin() + all.offset({0, y / layers.y, z / layers.z});
      for (std::int64_t x = 0; x < volume.shape.x; ++x) {
        out.labels.insert(out.labels.end(), static_cast<std::size_t>(layers.x), row[x]);
      }
    }
  }
  return out;
}

Frame layered_frame(const Frame& frame, Index3 layers) {
  return {.spacing = layered_spacing(frame.spacing, layers), .origin = frame.origin};
}

}  // namespace mw::audit
