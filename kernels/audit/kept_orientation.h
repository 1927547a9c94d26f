// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether a mesh that was turned is as positive as the one in the file.
#pragma once

#include "kernels/audit/check.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// "P2 orientation in the world": every tet has the sign in the file's coordinates that it has in
/// the array's axes, exactly; so rounding turned none over and made none flat.
/// written: positions as the file has them; mirrored: the world sees the array in a mirror.
/// REQUIRES: the tets name vertices of both lists, as many in each.
/// The same of the tets that a tile owns.
[[nodiscard]] Offenders changed_orientations(const MeshTile& turned,
                                             std::span<const Position> written, bool mirrored);
[[nodiscard]] Check kept_orientation(const Offenders& changed);

[[nodiscard]] Check check_kept_orientation(const AuditMesh& turned,
                                           std::span<const Position> written, bool mirrored);

}  // namespace mw::audit
