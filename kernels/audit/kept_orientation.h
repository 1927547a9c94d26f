// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether a mesh that was turned is as positive as the one in the file.
#pragma once

#include "kernels/audit/check.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// Of the tets that a tile owns, those that have another sign in the file's coordinates than in the
/// array's axes, exactly: rounding turned them over or made them flat.
/// written: positions as the file has them; mirrored: the world sees the array in a mirror.
/// REQUIRES: the tets name vertices of both lists, as many in each.
[[nodiscard]] Offenders changed_orientations(const MeshTile& turned,
                                             std::span<const Position> written, bool mirrored);
/// "P2 orientation in the world": there are none in any tile.
[[nodiscard]] Check kept_orientation(const Offenders& changed);

}  // namespace mw::audit
