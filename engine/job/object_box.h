// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether the box around an object is still that of the run whose work is used again.
#pragma once

#include "engine/job/mesh_job.h"

namespace mw::engine {

/// Does nothing unless the volume ends around an object and the folder of the job's KeepOptions
/// holds what a run has kept.
/// ERRORS: mw::Error(kUsage) when shape or origin of the volume are not those of that run, because
/// an edit made the object reach elsewhere: nothing that was kept lies where it would now.
void check_object_box(const io::VolumeInfo& volume, const MeshJob& job);

}  // namespace mw::engine
