// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The march: every window once, none before its predecessors (Sec 4.1).
#pragma once

#include <functional>
#include <span>

#include "engine/window_grid.h"

namespace mw::engine {

/// Processes one window.
using VisitWindow = std::function<void(Index3 window)>;

/// Chooses among windows that are ready; returns a position in the span, which is never empty.
using PickReady = std::function<std::size_t(std::span<const Index3> ready)>;

/// The reference: sequential, in raster order.
void march(const WindowGrid& grid, const VisitWindow& visit);

/// Sequential, in any order that respects predecessors, as `pick` decides.  Windows without a path
/// between them share no block, so the result is the same for every pick (promise P5).
void march(const WindowGrid& grid, const VisitWindow& visit, const PickReady& pick);

}  // namespace mw::engine
