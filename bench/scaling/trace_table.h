// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Traces of runs (--trace of mwmesh mesh), read for their durations.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "kernels/core/index.h"

namespace mw::bench {

enum class Clock { kCpu, kWall };

/// The visits of one march.
struct MarchTrace {
  Index3 windows;                    ///< along each axis
  std::vector<double> seconds;       ///< of each window, x fastest
  std::vector<std::uint64_t> bytes;  ///< set aside for each window, x fastest
};

/// REQUIRES: the trace of a whole run.
/// ERRORS: mw::Error(kInput) naming the line that is not one of a trace, or a missing window.
[[nodiscard]] std::vector<MarchTrace> read_trace(std::istream& in, Clock clock);

}  // namespace mw::bench
