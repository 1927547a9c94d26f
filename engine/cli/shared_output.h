// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which processes of a shared run write its mesh.
#pragma once

#include <memory>
#include <string>

#include "engine/cli/mesh_request.h"
#include "engine/exchange/team.h"
#include "io/mesh/shared_mesh.h"

namespace mw::cli {

/// What one process of a run writes the mesh into, together with the others.
struct SharedOutput {
  /// Of rank 0: made, unless it writes alone; of the others: for the case that rank 0 wants it.
  std::unique_ptr<io::SharedMesh> mesh;
  /// Of rank 0, where it writes alone: what for.
  std::string why_alone;
};

/// is_certified: rank 0 makes a certificate, for which the whole mesh has to pass by; so it has for
/// a page.
/// ERRORS: those of the file, which rank 0 makes.
[[nodiscard]] SharedOutput open_shared_output(const MeshRequest& request, const engine::Team& team,
                                              bool is_certified);

}  // namespace mw::cli
