// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Two signs a tet.
#include "kernels/audit/kept_orientation.h"

#include <algorithm>
#include <cmath>

#include "kernels/audit/orientation.h"

namespace mw::audit {
namespace {

int sign_of(std::span<const Position> at, const TetRow& t) {
  return orientation(at[t[0]], at[t[1]], at[t[2]], at[t[3]]);
}

bool is_finite(const Position& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

}  // namespace

Offenders changed_orientations(const MeshTile& turned, std::span<const Position> written,
                               bool mirrored) {
  Offenders wrong("tets");
  if (!std::all_of(written.begin(), written.end(), is_finite)) return wrong;
  // Tets of the turned mesh were mirrored with it: both see the same tet from the same side.
  for (std::size_t t = 0; t < turned.mesh.tets.size(); ++t) {
    if (!turned.owns_tet(t)) continue;
    TetRow tet = turned.mesh.tets[t];
    const int in_array = sign_of(turned.mesh.vertices, tet);
    if (mirrored) std::swap(tet[2], tet[3]);
    if (sign_of(written, tet) == in_array) continue;
    wrong.add([&] { return std::to_string(turned.tet_id(t)); });
  }
  return wrong;
}

Check kept_orientation(const Offenders& changed) {
  return {"P2 orientation in the world", changed.count() == 0,
          changed.text() + " change their sign by the rounding of coordinates"};
}

}  // namespace mw::audit
