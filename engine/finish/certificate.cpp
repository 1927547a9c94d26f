// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/certificate.h"

#include <string>

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

}  // namespace

audit::AuditReport certify(io::ScratchMesh& mesh, const CertificateTask& task,
                           const std::function<void()>& between) {
  MeshTiles tiles(task.volume.info(), task.volume.table(), {mesh.folder(), task.tiles_bytes});
  mesh.copy_to(tiles, between);
  audit::AuditReport report = verify_mesh(task.volume, tiles, task.check);
  if (report.passed()) return report;
  throw Error(ErrorKind::kCheckFailed,
              "the mesh does not pass its own check and is not delivered (please report this, with "
              "the volume and the settings): " +
                  failures(report));
}

}  // namespace mw::engine
