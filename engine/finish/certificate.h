// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A run checks its own mesh before it delivers it.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/verify/verify_mesh.h"
#include "io/mesh/scratch_mesh.h"
#include "kernels/audit/audit.h"

namespace mw::engine {

struct CertificateTask {
  const io::DenseVolume& volume;   ///< outlives the task
  VerifyTask check{};              ///< what the run promises, and with what it is checked
  std::uint64_t tiles_bytes = 0;   ///< what a mesh takes while it is taken apart into tiles
  std::uint64_t memory_bytes = 0;  ///< of all of it
};

/// Checks P1 to P4 and P8, as the run promises them.
/// ERRORS: mw::Error(kCheckFailed), naming what fails; those of verify_mesh().
[[nodiscard]] audit::AuditReport certify(io::ScratchMesh& mesh, const CertificateTask& task,
                                         const std::function<void()>& between);

}  // namespace mw::engine
