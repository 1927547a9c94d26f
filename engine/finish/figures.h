// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Figures of a finished mesh: shapes of tets, edges against sizes, interfaces, volumes of labels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "io/labels/label_table.h"
#include "io/mesh/scratch_mesh.h"
#include "io/volume/volume_space.h"
#include "kernels/audit/shape/quality.h"
#include "kernels/audit/shape/shape.h"
#include "kernels/core/index.h"
#include "kernels/core/lattice.h"

namespace mw::engine {

/// Counts edges of tets by length, as a share of the size that is asked for their label.  An edge
/// counts for each tet that has it.
struct EdgeRatios {
  static constexpr std::array<double, 7> kBounds{0.2, 0.4, 0.6, 0.8, 1.0, 1.25, 1.5};
  std::vector<std::uint64_t> counts = std::vector<std::uint64_t>(kBounds.size() + 1);

  /// A ratio that equals a bound counts below that bound.
  void add(double ratio);
};

/// What the figures of a mesh refer to.  The table outlives the task.
struct FiguresTask {
  const io::LabelTable& table;  ///< labels of the volume
  io::VolumeSpace space{};      ///< of the volume
  Index3 layers{1, 1, 1};       ///< into which each of its voxels was cut
  /// By dense label, 0 where no size was asked for; if empty, edges are not measured.
  std::vector<double> edge_sizes{};
  std::size_t sort_bytes = std::size_t{8} << 20U;
};

struct MeshFigures {
  audit::QualityReport quality;
  audit::ShapeReport shape;
  /// By dense label: six times its volume in cubic units of the lattice.  Corners of tets count as
  /// the nearest points of the lattice, where those of the marches lie.
  std::vector<Int128> label_volumes6;
  /// By dense label, in physical units, 0 where the mesh has no tet; empty if not measured.
  std::vector<double> longest_edges;
  EdgeRatios edge_ratios;
};

/// Measures a mesh of the volume.  Calls between(), which may throw, often.
/// Memory: bytes_to_measure(), and 24 bytes a label.  ERRORS: those of ScratchMesh.
[[nodiscard]] MeshFigures measure(
    io::ScratchMesh& mesh, const FiguresTask& task, const std::function<void()>& between = [] {});

/// Returns the most bytes that measure() holds beside the mesh, except for those of labels.
[[nodiscard]] std::uint64_t bytes_to_measure(const FiguresTask& task);

}  // namespace mw::engine
