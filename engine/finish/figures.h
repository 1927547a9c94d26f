// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Figures of a finished mesh: shapes of tets and interfaces.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/finish/tet_ranges.h"
#include "io/mesh/scratch_mesh.h"
#include "kernels/audit/shape/quality.h"
#include "kernels/audit/shape/shape.h"

namespace mw::engine {

struct FiguresTask {
  bool has_shape = true;  ///< whether interfaces are measured, too
  std::size_t sort_bytes = std::size_t{8} << 20U;
};

struct MeshFigures {
  audit::QualityReport quality;
  audit::ShapeReport shape;
  bool has_shape = false;
};

/// Measures a mesh.
/// Memory: bytes_to_measure().  ERRORS: those of ScratchMesh.
[[nodiscard]] MeshFigures measure(io::ScratchMesh& mesh, const FiguresTask& task,
                                  const TetWork& work = {});

/// Returns the most bytes that measure() holds beside the mesh and the work on ranges.
[[nodiscard]] std::uint64_t bytes_to_measure(const FiguresTask& task);

}  // namespace mw::engine
