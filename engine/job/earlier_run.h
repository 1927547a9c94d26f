// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run whose work is used again did with its volume: its steps as text for the folder of
// --keep, and whether the box around its object is still the same.
#pragma once

#include <string>

#include "engine/job/mesh_job.h"
#include "io/labels/prepared_input.h"

namespace mw::engine {

/// Returns a line for each rule of a merge, for specks, for labels between slices and for what is
/// welded.
[[nodiscard]] std::string text_of(const io::InputSteps& steps);
/// Returns the steps that text_of() made these lines of.  ERRORS: DamagedWork.
[[nodiscard]] io::InputSteps steps_of(const std::string& text);

/// Does nothing unless the volume ends around an object and the folder of the job's KeepOptions
/// holds what a run has kept.
/// ERRORS: mw::Error(kUsage) when shape or origin of the volume are not those of that run, because
/// an edit made the object reach elsewhere: nothing that was kept lies where it would now.
void check_object_box(const io::VolumeInfo& volume, const MeshJob& job);

}  // namespace mw::engine
