// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A final block in the coordinates that are written, and figures that final blocks give one by one;
// which process reads them in which order is free.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/output/finish.h"
#include "engine/output/label_selection.h"
#include "io/labels/label_table.h"
#include "io/mesh/mesh_sink.h"
#include "io/volume/volume_space.h"
#include "kernels/audit/shape/quality.h"
#include "kernels/core/lattice.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// Returns the place in the volume's space of a point of the lattice that cuts its voxels into
/// layers.  Each coordinate is divided once, so that corners of voxels stay whole numbers.
[[nodiscard]] inline io::Position physical(Point p, const io::VolumeSpace& space,
                                           Index3 layers = {1, 1, 1}) {
  const auto in_voxels = [](std::int32_t units, std::int64_t of_voxel) {
    return static_cast<double>(units) / static_cast<double>(of_voxel * kUnitsPerVoxel);
  };
  return to_world(space,
                  {in_voxels(p.x, layers.x), in_voxels(p.y, layers.y), in_voxels(p.z, layers.z)});
}

/// A final block as sinks take it, except that tets name vertices by their rows in the block.
struct WrittenBlock {
  BlockMesh block;                      ///< the part that is written
  std::vector<io::Position> positions;  ///< places of its vertices in the volume's space
  std::vector<io::TetRows> tets;        ///< positively oriented in the world, by rows of the block
  std::vector<RawLabel> labels;         ///< by tet
};

/// layers are those that each voxel of the volume was cut into.
[[nodiscard]] WrittenBlock written_block(BlockMesh block, const io::DenseVolume& volume,
                                         Index3 layers);

/// Returns the quality of the tets, by their numbers in the block.
[[nodiscard]] audit::QualityMeter quality_of(const WrittenBlock& block);

/// Replaces rows of the block by those of the mesh.
void give_rows(std::vector<io::TetRows>& tets, std::span<const std::uint64_t> rows);

/// Returns what is known of the mesh before its first row is written.
[[nodiscard]] io::MeshHeader header_of(const io::DenseVolume& volume,
                                       const LabelSelection& selection, std::uint64_t tets,
                                       const std::optional<io::MeshPromises>& promises);

/// Longest edges by label, and ratios of edges to sizes.  Memory: 16 bytes a label.  Cost: about
/// 10 ns a tet, 50 where its label has a size.
class LongestEdges {
 public:
  /// sizes are by dense label, 0 where it has none; empty if no label has one.
  explicit LongestEdges(std::size_t labels, std::vector<double> sizes = {})
      : squared_(labels, 0.0), sizes_(std::move(sizes)) {
    sizes_.resize(labels, 0.0);
  }

  /// positions are those of the block's vertices, by row.
  void add(std::span<const BlockTet> tets, std::span<const io::Position> positions) {
    for (const BlockTet& t : tets) {
      const auto& [a, b, c, d] = t.vertices;
      add(t.label, {positions[a], positions[b], positions[c], positions[d]});
    }
  }

  void add(Label label, const std::array<io::Position, 4>& corners) {
    double& longest = squared_[label];
    const double size = sizes_[label];
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double edge = squared(corners[i], corners[j]);
        longest = std::max(longest, edge);
        if (size > 0.0) ratios_.add(std::sqrt(edge) / size);
      }
    }
  }

  [[nodiscard]] EdgeRatios& ratios() { return ratios_; }
  /// Returns the squares of lengths(), so far.
  [[nodiscard]] std::vector<double>& squares() { return squared_; }
  /// Returns the longest edge by dense label; 0 where there is no tet.
  [[nodiscard]] std::vector<double> lengths() const {
    std::vector<double> out = squared_;
    for (double& length : out) length = std::sqrt(length);
    return out;
  }

 private:
  static double squared(const io::Position& a, const io::Position& b) {
    const double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2];
    return x * x + y * y + z * z;
  }

  std::vector<double> squared_;
  std::vector<double> sizes_;
  EdgeRatios ratios_;
};

/// Figures of the tets that are written: sums of whole numbers, and extremes.
/// Memory: 24 bytes a label.
struct BlockFigures {
  std::optional<audit::QualityMeter> quality;
  std::optional<LongestEdges> edges;
  bool has_volumes = false;
  std::vector<Int128> volumes6;  ///< by dense label; see FinishedMesh

  /// labels is the number of dense labels.
  BlockFigures(const OutputOptions& options, std::size_t labels);

  /// shape is the quality of the block's tets, by their numbers in the block; first_tet is the
  /// number of the first one in the mesh.
  void add(const WrittenBlock& block, const audit::QualityMeter& shape, std::uint64_t first_tet);

  /// Moves the figures into `out`; nothing may be added afterwards.
  void report(FinishedMesh& out);
};

}  // namespace mw::engine
