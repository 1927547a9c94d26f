// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The one place where errors become exit codes, and the end where no exception can pass.
#pragma once

#include <functional>

#include "kernels/core/error.h"

namespace mw::cli {

inline constexpr int kExitDone = 0;
inline constexpr int kExitInternal = 1;
inline constexpr int kExitUsage = 2;
inline constexpr int kExitInput = 3;
inline constexpr int kExitResource = 4;
inline constexpr int kExitCheckFailed = 5;
inline constexpr int kExitSaved = 75;  ///< interrupted, and --resume can go on
inline constexpr int kExitInterrupted = 130;

[[nodiscard]] int exit_code(ErrorKind kind);

/// Runs action; any exception becomes "mwmesh: error: ..." on stderr, unless quiet, and its exit
/// code.
[[nodiscard]] int guarded(const std::function<int()>& action, bool quiet = false) noexcept;

/// Makes the program end with a message and exit code 4, instead of SIGABRT, where std::bad_alloc
/// does not come as far as guarded(): from constructors of static objects, and from functions of
/// libraries that are noexcept though they allocate.  What it leaves is what a killed run leaves.
/// Thread safety: called once, before there are other threads.
void end_well_without_memory();

}  // namespace mw::cli
