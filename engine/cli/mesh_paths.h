// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether the files and the folder of a run are apart from each other.
#pragma once

#include "engine/cli/mesh_request.h"

namespace mw::cli {

/// Told before any work: what is written is not what is read, no name is written twice, and the
/// work folder neither is one of these files, nor lies in one, nor has one in it.
/// REQUIRES: the work folder of the request is settled.
/// ERRORS: mw::Error(kUsage) naming flag and path.
void require_paths_apart(const MeshRequest& request);

}  // namespace mw::cli
