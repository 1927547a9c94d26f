// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Loops on the threads of oneTBB.
#pragma once

#include <functional>

#include "kernels/core/index.h"
#include "kernels/core/parallel_for.h"

namespace mw::engine {

/// A ParallelFor on the threads of the arena that it is called in: a few ranges a thread, none
/// shorter than what a body's scratch is worth.  A thread that waits for the others takes no other
/// tasks of the arena meanwhile, so a window does not start inside another one.
/// ERRORS: what a body throws; the others may then not have run.
void tbb_for(std::size_t n, const RangeBody& body);

/// Calls visit for every index of an array of the given shape, once, on that many threads, or as
/// many as there can be; with one in order, x fastest, otherwise in any order.
/// REQUIRES: threads > 0.
/// ERRORS: what a visit throws; the others may then not have happened.
void tbb_for_each_index(int threads, Index3 shape, const std::function<void(Index3)>& visit);

}  // namespace mw::engine
