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
  if (task.has_shape) out.shape = interface_shape(mesh, task.sort_bytes, between);
  out.has_shape = task.has_shape;
  return out;
}

std::uint64_t bytes_to_measure(const FiguresTask& task) {
  const std::uint64_t sorts = task.has_shape ? 2 * std::uint64_t{task.sort_bytes} : 0;
  return sorts + (std::uint64_t{1} << 20U);
}

}  // namespace mw::engine
