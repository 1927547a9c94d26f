// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/figures.h"

#include "engine/finish/interface_shape.h"

namespace mw::engine {

MeshFigures measure(io::ScratchMesh& mesh, const FiguresTask& task,
                    const std::function<void()>& between) {
  MeshFigures out;
  audit::QualityMeter quality;
  mesh.each_tet_batch([&](const io::TetBatch& batch) {
    between();
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      quality.add(batch.first + t, mesh.corners(batch.tets[t]));
    }
  });
  out.quality = quality.report();
  out.shape = interface_shape(mesh, task.sort_bytes, between);
  return out;
}

std::uint64_t bytes_to_measure(const FiguresTask& task) {
  return 2 * std::uint64_t{task.sort_bytes} + (std::uint64_t{1} << 20U);
}

}  // namespace mw::engine
