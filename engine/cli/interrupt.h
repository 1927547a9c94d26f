// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM end a run between two steps, so that partial files are removed.
#pragma once

#include <string>

namespace mw::cli {

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
