// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/figures.h"

#include <array>
#include <cmath>
#include <utility>

#include "engine/finish/interface_shape.h"

namespace mw::engine {
namespace {

/// Takes the tets of a mesh one by one, with the dense label of each.
class TetFigures {
 public:
  explicit TetFigures(const FiguresTask& task) : task_(task), volumes6_(task.table.size()) {}

  void add(std::uint64_t number, const std::array<io::Position, 4>& corners, Label label) {
    quality_.add(number, corners);
    const Int128 volume = volume6(lattice_point(corners[0]), lattice_point(corners[1]),
                                  lattice_point(corners[2]), lattice_point(corners[3]));
    volumes6_[label] += volume < 0 ? -volume : volume;
  }

  void report(MeshFigures& out) {
    out.quality = quality_.report();
    out.label_volumes6 = std::move(volumes6_);
  }

 private:
  [[nodiscard]] Point lattice_point(const io::Position& p) const {
    const io::Vector3 corner = to_corner(task_.space, p);
    const auto units = [](double voxels, std::int64_t layers) {
      return static_cast<std::int32_t>(
          std::lround(voxels * static_cast<double>(layers * kUnitsPerVoxel)));
    };
    return {units(corner[0], task_.layers.x), units(corner[1], task_.layers.y),
            units(corner[2], task_.layers.z)};
  }

  const FiguresTask& task_;
  audit::QualityMeter quality_;
  std::vector<Int128> volumes6_;
};

}  // namespace

MeshFigures measure(io::ScratchMesh& mesh, const FiguresTask& task,
                    const std::function<void()>& between) {
  MeshFigures out;
  TetFigures tets(task);
  mesh.each_tet_batch([&](const io::TetBatch& batch) {
    between();
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      tets.add(batch.first + t, mesh.corners(batch.tets[t]), task.table.dense(batch.labels[t]));
    }
  });
  tets.report(out);
  out.shape = interface_shape(mesh, task.sort_bytes, between);
  return out;
}

std::uint64_t bytes_to_measure(const FiguresTask& task) {
  return 2 * std::uint64_t{task.sort_bytes} + (std::uint64_t{1} << 20U);
}

}  // namespace mw::engine
