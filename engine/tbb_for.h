// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// oneTBB behind the loops that kernels lend out.
#pragma once

#include "kernels/core/parallel_for.h"

namespace mw::engine {

/// A ParallelFor on the threads of the arena that it is called in: a few ranges a thread, none
/// shorter than what a body's scratch is worth.  A thread that waits for the others takes no other
/// tasks of the arena meanwhile, so a window does not start inside another one.
/// ERRORS: what a body throws; the others may then not have run.
void tbb_for(std::size_t n, const RangeBody& body);

}  // namespace mw::engine
