// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A long call that lets Python go on, tells how far it is, and ends at Ctrl-C.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "engine/mwmesh.h"

namespace mwmesh::python {

/// Calls work(hooks) in a thread of its own, without the interpreter's lock.  Meanwhile the calling
/// thread asks Python for signals ten times a second and calls progress(done, total, seconds_left),
/// unless it is None; what either raises cancels the work and is raised again.
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
