// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How long a march would take with a number of cores.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "engine/window/window_order.h"

namespace mw::bench {

/// Memory for windows that run (--memory).
struct WindowMemory {
  std::span<const std::uint64_t> bytes = {};  ///< of each window by rank; none take any if empty
  std::uint64_t budget = std::numeric_limits<std::uint64_t>::max();
};

/// Plays the march with the very bookkeeping of the engine (engine::Wavefront), but with `cores`
/// cores that cost nothing and take seconds[rank] for a window.  A window that memory has no room
/// for waits, as in the engine, and the first in sequence may pass it.
/// REQUIRES: seconds.size() == order.size(), none negative; cores >= 1; look_ahead >= 1.
/// ENSURES: the time at which the last window ends.
/// ERRORS: mw::Error(kResource) where a window alone has no room.
[[nodiscard]] double list_schedule(const engine::WindowOrder& order,
                                   std::span<const double> seconds, std::size_t cores,
                                   std::uint64_t look_ahead, const WindowMemory& memory = {});

/// The longest path, in seconds: no number of cores is faster.
[[nodiscard]] double longest_path(const engine::WindowOrder& order,
                                  std::span<const double> seconds);

}  // namespace mw::bench
