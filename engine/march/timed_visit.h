// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A visit and how long it took.
#pragma once

#include "engine/march/march.h"
#include "engine/system/stopwatch.h"

namespace mw::engine {

/// Visits the window and says when.  ERRORS: what visit throws.
inline Visited timed_visit(const VisitWindow& visit, Index3 window, int slot) {
  Visited out{.window = window, .start = {}, .end = {}, .slot = slot};
  const double cpu_before = thread_cpu_seconds();
  out.start = std::chrono::steady_clock::now();
  visit(window);
  out.end = std::chrono::steady_clock::now();
  out.cpu_seconds = thread_cpu_seconds() - cpu_before;
  return out;
}

}  // namespace mw::engine
