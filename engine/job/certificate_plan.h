// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether a run checks its own mesh, with how much memory, and what is checked.
#pragma once

#include "engine/finish/certificate.h"
#include "engine/job/mesh_job.h"

namespace mw::engine {

/// Returns the plan with as many threads as fit beside what the rest of the run takes while the
/// mesh is checked.  With Certify::kAuto there is none where not even one does: more memory must
/// not make a run impossible.
[[nodiscard]] CertificatePlan beside_others(const CertificatePlan& plan, const MeshJob& job,
                                            std::uint64_t others);

/// Returns what is checked of a mesh that was made with these promises.  The volume outlives the
/// task.  REQUIRES: plan.why_not is empty.
[[nodiscard]] CertificateTask certificate_task(const CertificatePlan& plan, const MeshJob& job,
                                               const io::DenseVolume& volume,
                                               const io::MeshPromises& promises);

}  // namespace mw::engine
