// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The end of a run: final blocks become one mesh with global rows.
#pragma once

#include "engine/block_store.h"
#include "io/labels/label_table.h"
#include "io/mesh/mesh_sink.h"

namespace mw::engine {

/// Size of the finished mesh.
struct FinishedMesh {
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
};

/// Loads every block of the store and writes the mesh: vertices ascending by id, tets by block
/// and canonical order inside it.  Coordinates are origin + spacing * voxel corner.
FinishedMesh finish(const BlockStore& store, const WindowGrid& grid, const io::DenseVolume& volume,
                    io::MeshSink& sink);

}  // namespace mw::engine
