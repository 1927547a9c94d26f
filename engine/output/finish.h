// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The end of a run: final blocks become one mesh with global rows, in bounded memory (promise P6).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/output/label_selection.h"
#include "engine/output/remembered.h"
#include "engine/system/in_order.h"
#include "engine/window/window_grid.h"
#include "io/mesh/mesh_sink.h"
#include "kernels/core/index.h"
#include "kernels/core/lattice.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// The blocks after the last march.  Reading leaves them as they are, so they may be read several
/// times.
class FinalBlocks {
 public:
  virtual ~FinalBlocks() = default;
  /// Returns a copy of the block.  Only vertices (id, position) and tets are looked at.
  /// Thread safety: as many threads as OutputOptions::work has may call it at once.
  [[nodiscard]] virtual BlockMesh load(Index3 block) = 0;
};

/// What the mesh is made from when the marches are over.
struct FinalMesh {
  FinalBlocks& blocks;
  const WindowGrid& grid;  ///< grid of the lattice, whose shape is the volume's times the layers
  const io::DenseVolume& volume;
};

/// What is written of the mesh.
struct OutputOptions {
  WantedLabel wanted;  ///< if empty, every label is written
  /// Optional; tets whose barycentres are in this box of the lattice are also counted apart.
  std::optional<Box3> within;
  HoldMemory hold;                           ///< optional
  std::optional<io::MeshPromises> promises;  ///< written into the file; set by mesh_volume()
  Index3 layers{1, 1, 1};  ///< what the volume's voxels were cut into; set by mesh_volume()
  WorkInOrder work;        ///< how blocks are worked on; set by mesh_volume()
};

/// What is known of a mesh that was written.
struct FinishedMesh {
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  std::uint64_t tets_within = 0;   ///< see OutputOptions::within
  std::size_t max_remembered = 0;  ///< see VertexRows; 16 bytes each
};

/// Reads every block twice, first for counts and uses of vertices, then to write them in raster
/// order.  What can be made from a block alone is made on several threads.
/// Vertices ascend by the first block that references them, then by id; tets ascend by block and
/// canonical order inside it.  Coordinates are those of the volume's space (to_world); layers do
/// not move corners of the volume's voxels.  Tets are positive in these coordinates.  Memory: the
/// blocks of `work`, what VertexRows remembers, 16 bytes a label and the sink's buffers.
FinishedMesh finish(const FinalMesh& mesh, io::MeshSink& sink, const OutputOptions& options = {});

}  // namespace mw::engine
