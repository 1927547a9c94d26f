// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sums of exact volumes over the tets of each label.
#include "engine/finish/label_volumes.h"

#include <array>
#include <cmath>

namespace mw::engine {
namespace {

Point lattice_point(const io::Position& p, const VolumesTask& task) {
  const io::Vector3 corner = to_corner(task.space, p);
  const auto units = [](double voxels, std::int64_t layers) {
    return static_cast<std::int32_t>(
        std::lround(voxels * static_cast<double>(layers * kUnitsPerVoxel)));
  };
  return {units(corner[0], task.layers.x), units(corner[1], task.layers.y),
          units(corner[2], task.layers.z)};
}

Int128 tet_volume6(const std::array<io::Position, 4>& corners, const VolumesTask& task) {
  const auto at = [&](std::size_t i) { return lattice_point(corners[i], task); };
  const Int128 volume = volume6(at(0), at(1), at(2), at(3));
  return volume < 0 ? -volume : volume;
}

}  // namespace

LabelAmounts label_amounts(io::ScratchMesh& mesh, const VolumesTask& task,
                           const std::function<void()>& between) {
  LabelAmounts out{std::vector<Int128>(task.table.size()),
                   std::vector<std::uint64_t>(task.table.size())};
  mesh.each_tet_batch([&](const io::TetBatch& batch) {
    between();
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      const Label label = task.table.dense(batch.labels[t]);
      out.volumes6[label] += tet_volume6(mesh.corners(batch.tets[t]), task);
      ++out.tets[label];
    }
  });
  return out;
}

}  // namespace mw::engine
