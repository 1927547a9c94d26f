// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/certificate.h"

#include <string>

#include "engine/finish/tet_ranges.h"
#include "engine/verify/mesh_tiles.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

/// Returns "P2 faces: 3 triangles ..., P3 ...".
std::string failures(const audit::AuditReport& report) {
  std::string out;
  for (const audit::Check& check : report.checks) {
    if (!check.passed) out += (out.empty() ? "" : "; ") + check.name + ": " + check.detail;
  }
  return out;
}

/// Gives a mesh to tiles, on all threads.
void take_apart(io::ScratchMesh& mesh, MeshTiles& tiles, const TetWork& work) {
  tiles.begin(mesh.header());
  mesh.each_vertex_batch([&](std::span<const io::Position> batch) {
    work.between();
    tiles.write_vertices(batch);
  });
  each_tet_range<MeshTiles::TetShare>(
      mesh, work,
      [&](const TetRange& range, io::CornerReader&) {
        return tiles.look_at(range.first, range.tets, range.labels);
      },
      [&](MeshTiles::TetShare&& found) { tiles.add(found); });
  tiles.finish();
}

}  // namespace

audit::AuditReport certify(io::ScratchMesh& mesh, const CertificateTask& task,
                           const std::function<void()>& between) {
  MeshTiles tiles(task.volume.info(), task.volume.table(), {mesh.folder(), task.tiles_bytes});
  take_apart(mesh, tiles, {.how = {task.check.threads}, .between = between});
  audit::AuditReport report = verify_mesh(task.volume, tiles, task.check);
  if (report.passed()) return report;
  throw Error(ErrorKind::kCheckFailed,
              "the mesh does not pass its own check and is not delivered (please report this, with "
              "the volume and the settings): " +
                  failures(report));
}

}  // namespace mw::engine
