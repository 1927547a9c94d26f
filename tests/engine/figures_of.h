// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The figures of a mesh in memory, as the last pass of a run measures them.
#pragma once

#include "engine/finish/figures.h"
#include "io/mesh/mesh_data.h"
#include "io/volume/label_volume.h"
#include "kernels/core/lattice.h"
#include "tests/temp_folder.h"

namespace mw::engine::test {

inline MeshFigures figures_of(const io::MeshData& mesh, const io::DenseVolume& volume) {
  const ::mw::test::TempFolder folder;
  io::ScratchMesh stored(folder.path());
  io::ScratchMeshSink into(stored);
  io::write_mesh(mesh, into);
  const io::VolumeSpace& space = volume.info().space;
  return measure(stored, {.table = volume.table(),
                          .space = space,
                          .layers = layers_of(space.spacing),
                          .sort_bytes = 1 << 16});
}

}  // namespace mw::engine::test
