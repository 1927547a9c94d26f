// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Loops on the threads of oneTBB.
#pragma once

#include <functional>

#include "kernels/core/index.h"
#include "kernels/core/parallel_for.h"

namespace mw::engine {

/// A ParallelFor on the threads of the arena that it is called in.  There are a few ranges a
/// thread, none so short that a body's scratch would cost more than its work.  A thread that waits
/// for the others takes no other tasks of the arena, so a window does not start inside another one.
/// ERRORS: what a body throws; other bodies may then be left out.
void tbb_for(std::size_t n, const RangeBody& body);

/// Calls visit once for every index of an array of the given shape, on `threads` threads or as many
/// as the system gives.  One thread goes in order, x fastest; several go in any order.
/// REQUIRES: threads > 0.
/// ERRORS: what a visit throws; other visits may then be left out.
void tbb_for_each_index(int threads, Index3 shape, const std::function<void(Index3)>& visit);

}  // namespace mw::engine
