// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How a command ends: errors become exit codes in one place, which no exception can pass, and
// Ctrl-C and SIGTERM end a run between two steps, so that partial files are removed.
#pragma once

#include <functional>
#include <string>

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

/// Thrown by stop_if_interrupted().
struct Interrupted {
  std::string work;  ///< where the work so far is and how to go on; empty if there is none
};

/// After this the first SIGINT, SIGTERM or SIGHUP is only noted; a second one of the same kind
/// kills.  A signal that was ignored at the start (nohup) stays ignored.
void watch_interrupts();

/// Makes these signals end the program at once with kExitInterrupted, and say so, until
/// watch_interrupts() is called: before that there is nothing to be left in order.
void end_if_interrupted();

/// Makes these signals end the program at once with kExitDone: for a command that goes on until
/// then and leaves nothing behind.
void end_well_if_interrupted();

/// ERRORS: Interrupted when a signal has been noted.  Thread-safe.
void stop_if_interrupted();

/// After this SIGUSR1, which mpirun passes on, asks a run of several processes to save and end.
void watch_save_requests();
[[nodiscard]] bool is_save_requested();

}  // namespace mw::cli
