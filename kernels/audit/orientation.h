// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The side on which a tet's last vertex lies, decided exactly from the given doubles.
#pragma once

#include <optional>

#include "kernels/audit/subject.h"

namespace mw::audit {

/// Sign of det(b - a, c - a, d - a): 1 for a tet that is positive in VTK's sense, 0 for a flat one.
/// The determinant is meant for the doubles as they are, not as rounded differences.
/// REQUIRES: finite coordinates.  ENSURES: exact.
/// Cost: some 30 operations; 100 times as much for nearly flat tets.
[[nodiscard]] int orientation(const Position& a, const Position& b, const Position& c,
                              const Position& d);

/// The same in floating point, with a bound on its error in the manner of Shewchuk 1997, orient3d,
/// stage A; nothing when the bound does not decide.
[[nodiscard]] std::optional<int> filtered_orientation(const Position& a, const Position& b,
                                                      const Position& c, const Position& d);

/// The same in whole numbers of any length.
[[nodiscard]] int exact_orientation(const Position& a, const Position& b, const Position& c,
                                    const Position& d);

}  // namespace mw::audit
