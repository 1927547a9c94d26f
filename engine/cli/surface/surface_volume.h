// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh surface straight from a volume: meshes no more of it than the surfaces need.
#pragma once

#include <string>
#include <vector>

#include "engine/cli/requests.h"
#include "io/mesh/mesh_sink.h"

namespace mw::cli {

/// Returns whether the input is a volume, as its name is not that of a mesh.
[[nodiscard]] bool is_volume(const std::filesystem::path& input);

/// Adds the options of volumes and of meshing, most of them for experts.
/// REQUIRES: request outlives options.
void add_volume_route(OptionSet& options, MeshRequest& request);

/// ERRORS: mw::Error(kUsage) naming the first of these options that was given as a flag, though the
/// input is a mesh.
void refuse_flags_of_volumes(const OptionSet& options, const std::filesystem::path& mesh);

/// Meshes the request's volume into the sink.  If labels are given they alone are meshed: all
/// others become one label, which is left out, and the volume ends around them (--object).  Where
/// labels are not those of voxels, as with --merge, or all are needed, as with --periodic, the
/// whole volume is meshed and the others are left out.
/// What memory does not hold waits in a folder below io::scratch_folder(), which is removed.
/// ERRORS: those of opening and meshing a volume; Interrupted.
void mesh_volume(MeshRequest& request, const std::vector<RawLabel>& labels, io::MeshSink& sink);

}  // namespace mw::cli
