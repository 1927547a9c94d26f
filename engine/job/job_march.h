// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The marches of a job.
#pragma once

#include "engine/job/mesh_job.h"

namespace mw::engine {

/// Returns what the marches are told, beyond what the job says.
[[nodiscard]] RunHooks run_hooks(const MeshJob& job, const report::FinishedRun& run,
                                 std::uint64_t memory);

/// Marches, and says where the work is when a run that ends early leaves some.
/// ERRORS: those of mesh_volume().
[[nodiscard]] RunReport march(const io::DenseVolume& labels, const MeshJob& job, io::MeshSink& sink,
                              RunHooks run);

}  // namespace mw::engine
