// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a job asks of the mesh behind the marches.
#pragma once

#include "engine/finish/finish_task.h"
#include "engine/job/mesh_job.h"

namespace mw::engine {

/// Returns the passes that follow from a job and its labels alone, which the run outlives.
[[nodiscard]] FinishTask finish_task(const MeshJob& job, const report::FinishedRun& run);

}  // namespace mw::engine
