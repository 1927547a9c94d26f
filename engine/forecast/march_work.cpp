// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Predicts costs of windows and of the output.
#include "engine/forecast/run_forecast.h"

#include <algorithm>

#include "kernels/core/index.h"

namespace mw::engine {
namespace {

// Microseconds, by least squares from traces of runs (--trace).
constexpr double kPerWindow = 200;
constexpr double kPerBoxFace = 0.3;    // for each face of a voxel on the volume's box
constexpr double kPerDenseVoxel = 12;  // for each voxel of the start mesh of five tets a voxel
constexpr double kPerOutputBlock = 15, kPerOutputFace = 0.2;
// Constrained ODT by TetGen takes 3 to 9 times what the rest of its march does.
constexpr double kTetgenFactor = 5;

/// Returns the number of faces of voxels of `part` on the box of a volume.
double faces_on_box(const Box3& part, Index3 volume) {
  const Index3 s = part.shape();
  const auto ends = [](std::int64_t lo, std::int64_t hi, std::int64_t size) {
    return (lo == 0 ? 1 : 0) + (hi == size ? 1 : 0);
  };
  return static_cast<double>(s.y * s.z * ends(part.lo.x, part.hi.x, volume.x) +
                             s.x * s.z * ends(part.lo.y, part.hi.y, volume.y) +
                             s.x * s.y * ends(part.lo.z, part.hi.z, volume.z));
}

/// These return the first and the last of `windows` windows along an axis that hold the block.
std::int64_t first_with(std::int64_t block) {
  return std::max<std::int64_t>(0, block - 1);
}

std::int64_t last_with(std::int64_t block, std::int64_t windows) {
  return std::min(block, windows - 1);
}

}  // namespace

MarchWork::MarchWork(const BoundaryFaces& faces, const WindowOrder& order,
                     const MeshSettings& settings, MarchIndex position)
    : faces_(faces),
      order_(order),
      per_face_(position.is_first ? 5.5 : 3),
      per_new_face_(position.is_first ? 12 : 7),
      per_new_voxel_(position.is_first && settings.start == StartMesh::kDense ? kPerDenseVoxel : 0),
      density_factor_(position.is_first ? 1.5 : 4.5) {
  if (position.is_last && settings.optimizer == Optimizer::kTetgen) {
    per_face_ *= kTetgenFactor;
    per_new_face_ *= kTetgenFactor;
  }
}

double MarchWork::of(Index3 window) const {
  const WindowGrid& grid = order_.grid();
  double faces = 0, new_faces = 0, new_voxels = 0;
  for (const Index3 block : grid.blocks_of(window)) {
    const Box3 part = grid.block_box(block);
    const double more = faces_.in(part);
    faces += more;
    if (!sees_first(window, block)) continue;
    new_faces += more;
    new_voxels += static_cast<double>(part.voxels());
  }
  const Box3 box = grid.window_box(window);
  const double density = faces / static_cast<double>(box.voxels());
  return kPerWindow + kPerBoxFace * faces_on_box(box, grid.volume()) +
         per_face_ * faces * (1 + density_factor_ * density) + per_new_face_ * new_faces +
         per_new_voxel_ * new_voxels;
}

double MarchWork::of_all() const {
  double work = 0;
  for_each_index(order_.grid().windows(), [&](Index3 window) { work += of(window); });
  return work;
}

/// True if no earlier window of the sequence holds the block.
bool MarchWork::sees_first(Index3 window, Index3 block) const {
  const Index3 windows = order_.grid().windows();
  const Box3 holders{{first_with(block.x), first_with(block.y), first_with(block.z)},
                     {last_with(block.x, windows.x) + 1, last_with(block.y, windows.y) + 1,
                      last_with(block.z, windows.z) + 1}};
  const std::uint64_t rank = order_.rank(window);
  bool first = true;
  for_each_index(holders, [&](Index3 other) { first = first && order_.rank(other) >= rank; });
  return first;
}

double output_work(const BoundaryFaces& faces, const Box3& block) {
  return kPerOutputBlock + kPerOutputFace * faces.in(block);
}

}  // namespace mw::engine
