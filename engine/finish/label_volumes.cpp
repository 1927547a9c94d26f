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

/// Remembers where vertices lie on the lattice, since some twenty tets have the same one.
class LatticePoints {
 public:
  explicit LatticePoints(const VolumesTask& task) : task_(task), known_(kKnown) {}

  [[nodiscard]] Point of(std::uint64_t row, const io::Position& place) {
    Known& known = known_[row % kKnown];
    if (known.row != row) known = {row, lattice_point(place, task_)};
    return known.point;
  }

 private:
  static constexpr std::size_t kKnown = 2048;
  struct Known {
    std::uint64_t row = ~std::uint64_t{0};
    Point point;
  };

  const VolumesTask& task_;
  std::vector<Known> known_;
};

/// Tets of one label that follow one another.
struct LabelRun {
  RawLabel label = 0;
  std::uint64_t tets = 0;
  Int128 volume6 = 0;
};

std::vector<LabelRun> runs_of(const TetRange& range, io::CornerReader& corners,
                              const VolumesTask& task) {
  std::vector<LabelRun> out;
  LatticePoints points(task);
  for (std::size_t t = 0; t < range.tets.size(); ++t) {
    const io::TetRows& rows = range.tets[t];
    const std::array<io::Position, 4> places = corners.corners(rows);
    const auto at = [&](std::size_t i) { return points.of(rows[i], places[i]); };
    const Int128 volume = volume6(at(0), at(1), at(2), at(3));
    if (out.empty() || out.back().label != range.labels[t])
      out.push_back({.label = range.labels[t]});
    ++out.back().tets;
    out.back().volume6 += volume < 0 ? -volume : volume;
  }
  return out;
}

}  // namespace

LabelAmounts label_amounts(io::ScratchMesh& mesh, const VolumesTask& task, const TetWork& work) {
  LabelAmounts out{std::vector<Int128>(task.table.size()),
                   std::vector<std::uint64_t>(task.table.size())};
  each_tet_range<std::vector<LabelRun>>(
      mesh, work,
      [&](const TetRange& range, io::CornerReader& corners) {
        return runs_of(range, corners, task);
      },
      [&](std::vector<LabelRun>&& runs) {
        for (const LabelRun& run : runs) {
          const Label label = task.table.dense(run.label);
          out.volumes6[label] += run.volume6;
          out.tets[label] += run.tets;
        }
      });
  return out;
}

}  // namespace mw::engine
