// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Signals end a run between two steps.
#include "engine/cli/exit_code.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <stdexcept>
#include <string_view>

namespace mw::cli {
namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

std::atomic<bool> save_requested = false;

void note_signal(int /*signal*/) {
  interrupted = true;
}

/// Handles the signals that end a run, except those that the caller of the program had it ignore.
void handle(void (*handler)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
    sigaction(signal, &action, nullptr);
  }
}

void end_now(int /*signal*/) {
  constexpr std::string_view kMessage = "mwmesh: error: interrupted; nothing was written\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  ::_exit(kExitInterrupted);
}

}  // namespace

void watch_interrupts() {
  handle(note_signal);
}

void end_if_interrupted() {
  handle(end_now);
}

void end_well_if_interrupted() {
  handle([](int) { ::_exit(kExitDone); });
}

void watch_save_requests() {
  struct sigaction action {};
  action.sa_handler = [](int) { save_requested = true; };
  action.sa_flags = SA_RESTART;
  sigaction(SIGUSR1, &action, nullptr);
}

bool is_save_requested() {
  return save_requested;
}

void stop_if_interrupted() {
  if (interrupted) throw Interrupted{};
}

}  // namespace mw::cli
