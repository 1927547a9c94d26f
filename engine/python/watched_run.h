// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A long call that lets Python go on, tells how far it is, and ends at Ctrl-C.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "engine/mwmesh.h"

namespace mwmesh::python {

/// Is without the interpreter's lock while it lives.  A thread that asks for the lock once the
/// interpreter is gone is ended by force, which aborts the program; so the interpreter waits for
/// all of these before it ends (end_runs_at_exit()).
/// REQUIRES: begins and ends in one thread, which holds the lock before and after.
class WithoutLock {
 public:
  WithoutLock() = default;

 private:
  /// Counts with the lock held: the members begin in this order and end in the other.
  struct Counted {
    /// ERRORS: Error(kCancelled) when the interpreter is about to end.
    Counted();
    ~Counted();
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;
  };
  Counted counted_;
  pybind11::gil_scoped_release no_lock_;
};

/// Makes the interpreter, before it ends, cancel the runs of daemon threads, and wait until nobody
/// is without the lock.  To be called once.
void end_runs_at_exit();

/// Calls work(hooks) in a thread of its own, without the interpreter's lock.  Meanwhile the calling
/// thread asks Python for signals ten times a second and calls progress(done, total, seconds_left),
/// unless it is None; what either raises cancels the work and is raised again.  The end of the
/// interpreter cancels it, too.
/// REQUIRES: the caller holds the lock.
void run_watched(const pybind11::object& progress, const std::function<void(const Hooks&)>& work);

/// Does the same for work that returns a value, and returns that value.
template <class Work>
auto watched_run(const pybind11::object& progress, const Work& work) {
  std::optional<decltype(work(Hooks{}))> result;
  run_watched(progress, [&](const Hooks& hooks) { result.emplace(work(hooks)); });
  return std::move(*result);
}

}  // namespace mwmesh::python
