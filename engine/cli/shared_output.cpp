// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cli/shared_output.h"

#include "io/mesh/open_mesh.h"

namespace mw::cli {

SharedOutput open_shared_output(const MeshRequest& request, const engine::Team& team,
                                bool is_certified) {
  SharedOutput out{.mesh = io::open_shared_mesh(request.output, request.element), .why_alone = ""};
  if (!team.is_first()) return out;
  if (team.ranks() == 1) {
    out.why_alone = "there is no other";
  } else if (out.mesh == nullptr) {
    out.why_alone = "only a .vtkhdf of tet4 can be written by several";
  } else if (is_certified) {
    out.why_alone = "it makes the certificate";
  } else if (!request.html.empty()) {
    out.why_alone = "it draws the page";
  } else {
    out.mesh->create();
    return out;
  }
  out.mesh.reset();
  return out;
}

}  // namespace mw::cli
