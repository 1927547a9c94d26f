// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The end of a run: final blocks become one mesh with global rows, in bounded memory (promise P6).
#pragma once

#include <functional>
#include <optional>

#include "engine/final_blocks.h"
#include "engine/label_selection.h"
#include "engine/window_grid.h"
#include "io/mesh/mesh_sink.h"
#include "kernels/audit/quality.h"

namespace mw::engine {

/// Told how much the merge remembers of vertices, before that grows beyond what was last told; may
/// throw.
using HoldMemory = std::function<void(std::uint64_t bytes)>;

/// What is written and told of the mesh.
struct OutputOptions {
  WantedLabel wanted;            ///< empty: every label
  bool measure_quality = false;  ///< about 0.1 us a tet
  HoldMemory hold;               ///< optional
  Index3 layers{1, 1, 1};        ///< that the volume's voxels were cut into; set by mesh_volume()
};

/// The finished mesh.
struct FinishedMesh {
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  std::optional<audit::QualityReport> quality;
  std::size_t most_remembered = 0;  ///< see VertexRows; 16 bytes each
};

/// Reads every block twice in raster order, first for counts and uses of vertices, then to write.
/// Vertices ascend by the first block that references them, then by id; tets by block and canonical
/// order inside it.  Coordinates are origin + spacing * voxel corner of the volume, and exactly
/// that on corners, whatever the layers.
/// grid: of the lattice, layers times the volume's shape.
/// Memory: one block, what VertexRows remembers, and the sink's buffers.
FinishedMesh finish(FinalBlocks& blocks, const WindowGrid& grid, const io::DenseVolume& volume,
                    io::MeshSink& sink, const OutputOptions& options = {});

}  // namespace mw::engine
