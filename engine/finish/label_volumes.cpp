// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sums of exact volumes over the tets of each label.
#include "engine/finish/label_volumes.h"

#include <array>
#include <cmath>
#include <utility>

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

LabelAmounts label_amounts(io::ScratchMesh& mesh, const VolumesTask& task, const TetWork& work) {
  LabelAmounts out{std::vector<Int128>(task.table.size()),
                   std::vector<std::uint64_t>(task.table.size())};
  using TetVolumes = std::vector<std::pair<Label, Int128>>;
  each_tet_range<TetVolumes>(
      mesh, work,
      [&](const TetRange& range, io::CornerReader& corners) {
        TetVolumes of_range;
        of_range.reserve(range.tets.size());
        for (std::size_t t = 0; t < range.tets.size(); ++t) {
          of_range.emplace_back(task.table.dense(range.labels[t]),
                                tet_volume6(corners.corners(range.tets[t]), task));
        }
        return of_range;
      },
      [&](TetVolumes&& of_range) {
        for (const auto& [label, volume6] : of_range) {
          out.volumes6[label] += volume6;
          ++out.tets[label];
        }
      });
  return out;
}

}  // namespace mw::engine
