// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The side on which a tet's last vertex lies, decided exactly from the given doubles, and whether
// a mesh that was turned is as positive as the one in the file.
#pragma once

#include <optional>

#include "kernels/audit/check.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// Sign of det(b - a, c - a, d - a): 1 for a tet that is positive in VTK's sense, 0 for a flat one.
/// The determinant is meant for the doubles as they are, not as rounded differences.
/// REQUIRES: finite coordinates.  ENSURES: exact.
/// Cost: some 30 operations; 100 times as much for nearly flat tets.
[[nodiscard]] int orientation(const Position& a, const Position& b, const Position& c,
                              const Position& d);

/// Decides it in floating point, with a bound on its error in the manner of Shewchuk 1997,
/// orient3d, stage A; nothing when the bound does not decide.
[[nodiscard]] std::optional<int> filtered_orientation(const Position& a, const Position& b,
                                                      const Position& c, const Position& d);

/// Decides it in whole numbers of any length.
[[nodiscard]] int exact_orientation(const Position& a, const Position& b, const Position& c,
                                    const Position& d);

/// Finds the tets that a tile owns whose exact sign in the file's coordinates is another one than
/// in the array's axes, because rounding turned them over or made them flat.  written holds the
/// positions in the file; mirrored says that the world sees the array in a mirror.
/// REQUIRES: the tets name vertices of both lists, as many in each.
[[nodiscard]] Offenders changed_orientations(const MeshTile& turned,
                                             std::span<const Position> written, bool mirrored);
/// Returns the check "P2 orientation in the world": no tile has such tets.
[[nodiscard]] Check kept_orientation(const Offenders& changed);

}  // namespace mw::audit
