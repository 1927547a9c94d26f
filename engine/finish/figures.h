// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Figures of a finished mesh: shapes of tets, interfaces, volumes of labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "io/labels/label_table.h"
#include "io/mesh/scratch_mesh.h"
#include "io/volume/volume_space.h"
#include "kernels/audit/shape/quality.h"
#include "kernels/audit/shape/shape.h"
#include "kernels/core/index.h"
#include "kernels/core/lattice.h"

namespace mw::engine {

/// What the figures of a mesh refer to.  The table outlives the task.
struct FiguresTask {
  const io::LabelTable& table;  ///< labels of the volume
  io::VolumeSpace space{};      ///< of the volume
  Index3 layers{1, 1, 1};       ///< into which each of its voxels was cut
  std::size_t sort_bytes = std::size_t{8} << 20U;
};

struct MeshFigures {
  audit::QualityReport quality;
  audit::ShapeReport shape;
  /// By dense label: six times its volume in cubic units of the lattice.  Corners of tets count as
  /// the nearest points of the lattice, where those of the marches lie.
  std::vector<Int128> label_volumes6;
};

/// Measures a mesh of the volume.  Calls between(), which may throw, often.
/// Memory: bytes_to_measure(), and 16 bytes a label.  ERRORS: those of ScratchMesh.
[[nodiscard]] MeshFigures measure(
    io::ScratchMesh& mesh, const FiguresTask& task, const std::function<void()>& between = [] {});

/// Returns the most bytes that measure() holds beside the mesh, except for those of labels.
[[nodiscard]] std::uint64_t bytes_to_measure(const FiguresTask& task);

}  // namespace mw::engine
