// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes below some 1.4 voxels: the marches make edges twice as long, and the mesh that is written
// has each tet cut into eight, with interfaces that are smoother than those of the marches.
#pragma once

#include "engine/finish/cut.h"
#include "engine/job/mesh_job.h"

namespace mw::engine {

/// Returns how often the tets of a run are cut: as often as its least size asks for, where that is
/// below least_size() (1.39 voxels where these are cubes); never with a count, as sizes are weights
/// then.  in_image is the least size of the image, or infinity without one; what it asks for beyond
/// io::kMostHalvings is left out.
/// ERRORS: mw::Error(kUsage) when io::kMostHalvings cuts are not enough for another size, with the
/// least size that can be kept.
[[nodiscard]] int halvings_of(const io::VolumeInfo& volume, const MeshJob& job, double in_image);

/// Returns the settings for marches whose tets are cut this often afterwards: larger sizes, and a
/// smaller bound on the distance, as interfaces move when they become smoother.
[[nodiscard]] MeshSettings before_halvings(MeshSettings settings, int times);

/// Returns how the mesh is cut.  The job has the settings that were asked for.
[[nodiscard]] CutTask cut_task(int times, const MeshJob& job, const io::VolumeInfo& volume);

}  // namespace mw::engine
