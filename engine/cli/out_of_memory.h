// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The end of the program where memory is out and no exception can pass.
#pragma once

namespace mw::cli {

/// std::bad_alloc becomes an error in guarded().  It does not come that far from constructors of
/// static objects and from functions of libraries that are noexcept though they allocate: the
/// program then ends with the same message and exit code 4, instead of SIGABRT.  What it leaves is
/// what a killed run leaves.
/// Thread safety: once, before there are other threads.
void end_well_without_memory();

}  // namespace mw::cli
