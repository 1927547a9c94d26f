// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How long the marches of a run would take on several machines.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bench/scaling/run_flow.h"
#include "engine/team/blocks/partition.h"

namespace mw::bench {

/// What there is to work with.
struct Machines {
  int ranks = 1;
  std::size_t cores = 1;                 ///< of a rank
  std::uint64_t look_ahead = 0;          ///< 0: the march's own
  double latency = 0.0;                  ///< seconds until a parcel that left is there
  double bandwidth = 1.25e9;             ///< bytes a second that a rank can send
  std::vector<double> block_bytes{0.0};  ///< of a parcel, by march; the last one's goes on
};

/// What came of it.
struct TeamSchedule {
  double seconds = 0.0;                ///< until the last visit ends
  double output_seconds = 0.0;         ///< until rank 0 has all blocks of the output
  double output_bytes = 0.0;           ///< that come to rank 0 for the output
  std::vector<std::uint64_t> parcels;  ///< sent, by rank
  std::vector<double> bytes;           ///< sent, by rank
  std::vector<double> held;            ///< bytes of blocks that wait for a window, at most, by rank
};

/// Plays the marches with the very bookkeeping of the engine (ArrivalFront, Arrivals), with cores
/// that cost nothing and take seconds[w] for window w.  A window is ready when its inputs are
/// there; a block for another rank leaves when the visit that made it is over and the rank's link
/// is free, and is there `latency` later.  A rank begins its next march when its own windows of the
/// march are done.  Receiving costs nothing. REQUIRES: seconds.size() == flow.windows(), none
/// negative; partition deals to machines.ranks.
[[nodiscard]] TeamSchedule team_schedule(const RunFlow& flow, std::span<const double> seconds,
                                         const engine::Partition& partition,
                                         const Machines& machines);

/// The longest path through all marches, in seconds: no number of cores is faster.
[[nodiscard]] double longest_path(const RunFlow& flow, std::span<const double> seconds);

}  // namespace mw::bench
