// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How long a march would take with a number of cores.
#pragma once

#include <span>

#include "engine/window/window_order.h"

namespace mw::bench {

/// Plays the march with the very bookkeeping of the engine (engine::Wavefront), but with `cores`
/// cores that cost nothing and take seconds[rank] for a window. REQUIRES: seconds.size() ==
/// order.size(), none negative; cores >= 1; look_ahead >= 1. ENSURES:  the time at which the last
/// window ends.
[[nodiscard]] double list_schedule(const engine::WindowOrder& order,
                                   std::span<const double> seconds, std::size_t cores,
                                   std::uint64_t look_ahead);

/// The longest path, in seconds: no number of cores is faster.
[[nodiscard]] double longest_path(const engine::WindowOrder& order,
                                  std::span<const double> seconds);

}  // namespace mw::bench
