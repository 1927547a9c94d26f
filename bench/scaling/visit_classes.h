// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Durations of windows, drawn from those of a trace.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "bench/scaling/run_flow.h"
#include "bench/scaling/trace_table.h"

namespace mw::bench {

/// Windows are alike when they belong to the same march and find the same share of their blocks
/// untouched by it: a fresh block is where the work is.
class VisitClasses {
 public:
  /// The traced run's flow, and seconds of its windows by their numbers there.
  VisitClasses(const RunFlow& flow, const std::vector<double>& seconds);

  /// For each window of a run, by number, the duration of any of the trace's windows of its class;
  /// where the trace has none, of the class with the next smaller share, or else the next larger.
  /// Draws are independent; the same seed draws the same.
  /// ERRORS: mw::Error(kUsage) when the run has a march that the trace lacks.
  [[nodiscard]] std::vector<double> draw(const RunFlow& flow, std::uint64_t seed) const;

 private:
  using Class = std::pair<std::uint32_t, int>;  ///< march, fresh eighths

  [[nodiscard]] const std::vector<double>& durations(const Class& wanted) const;

  std::map<Class, std::vector<double>> durations_;
};

/// A trace's seconds by number of window.
/// ERRORS: mw::Error(kInput) when the trace is of another grid.
[[nodiscard]] std::vector<double> traced_seconds(const RunFlow& flow,
                                                 const std::vector<MarchTrace>& trace);

}  // namespace mw::bench
