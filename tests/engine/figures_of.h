// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The figures of a mesh in memory, as the last passes of a run measure them.
#pragma once

#include "engine/finish/figures.h"
#include "engine/finish/label_volumes.h"
#include "io/mesh/mesh_data.h"
#include "io/volume/label_volume.h"
#include "kernels/core/lattice.h"
#include "tests/temp_folder.h"

namespace mw::engine::test {

struct FiguresAndVolumes : MeshFigures {
  std::vector<Int128> label_volumes6;
};

inline FiguresAndVolumes figures_of(const io::MeshData& mesh, const io::DenseVolume& volume) {
  const ::mw::test::TempFolder folder;
  io::ScratchMesh stored(folder.path());
  io::ScratchMeshSink into(stored);
  io::write_mesh(mesh, into);
  const io::VolumeSpace& space = volume.info().space;
  return {measure(stored, {.sort_bytes = 1 << 16}),
          label_amounts(
              stored, {.table = volume.table(), .space = space, .layers = layers_of(space.spacing)})
              .volumes6};
}

}  // namespace mw::engine::test
