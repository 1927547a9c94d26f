// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which windows have to be visited again because what they left was given up.
#pragma once

#include <functional>
#include <vector>

#include "engine/store/run_layout.h"

namespace mw::engine {

/// True if a window sees what its record says.  It is called in the order of the run, and only for
/// windows that take blocks from no window for which that may be false.
using Recalls = std::function<bool(const WindowKey& key)>;
/// True if the bytes that a window left were given up.
using IsDropped = std::function<bool(std::uint64_t window)>;

/// Returns, by window, which windows have to be visited because their bytes were given up and a
/// window that is visited takes their blocks.  A window is visited if it may see something else
/// than its record says, or if it is one of those returned.
/// Cost: a call of `recalls` a window.  Memory: two bits a window.
[[nodiscard]] std::vector<bool> required_visits(const RunLayout& layout, const Recalls& recalls,
                                                const IsDropped& is_dropped);

}  // namespace mw::engine
