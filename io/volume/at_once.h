// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How readers of volumes borrow a loop: their caller may bring threads, they know none.
#pragma once

#include <functional>

#include "kernels/core/index.h"

namespace mw::io {

/// Calls visit for each index of an array of this shape, for up to `threads` of them at once.
/// ERRORS: what a visit throws; other visits may then be left out.
using VisitAtOnce =
    std::function<void(int threads, Index3 shape, const std::function<void(Index3 index)>& visit)>;

/// Calls visit for one index after the other, x fastest.
inline void visit_in_turn(int /*threads*/, Index3 shape,
                          const std::function<void(Index3 index)>& visit) {
  for_each_index(shape, visit);
}

}  // namespace mw::io
