// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Marches of several ranks in which windows sleep instead of working: wall-clock time without
// cores.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/scaling/team_schedule.h"

namespace mw::bench {

/// What was measured.
struct SleepingRun {
  double seconds = 0.0;                ///< until the last rank is through
  std::vector<std::uint64_t> parcels;  ///< sent, by rank, those for the output aside
};

/// The engine's march (ArrivalFront, the flow graph) with ranks as threads and messages without
/// bytes, which take no time but that of their threads; window w sleeps for seconds[w].
/// Only ranks, cores and look_ahead of the machines have an effect.
/// REQUIRES: a system that gives ranks x cores threads.
[[nodiscard]] SleepingRun sleeping_run(const RunFlow& flow, std::span<const double> seconds,
                                       const engine::Partition& partition,
                                       const Machines& machines);

}  // namespace mw::bench
