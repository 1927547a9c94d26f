// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which windows have to be visited again because what they left was given up.
#pragma once

#include <functional>
#include <vector>

#include "engine/store/run_layout.h"

namespace mw::engine {

/// Whether a window sees what its record says, if those do from which it takes blocks.  Called in
/// the order of the run, only for windows of which all of these do.
using Recalls = std::function<bool(const WindowKey& key)>;
/// Whether the bytes that a window left are nowhere.
using IsDropped = std::function<bool(std::uint64_t window)>;

/// Returns, by window, those that some window may need which has to be visited: one that may see
/// something else than its record says, or one that is returned.
/// Cost: a call of `recalls` a window.
[[nodiscard]] std::vector<bool> required_visits(const RunLayout& layout, const Recalls& recalls,
                                                const IsDropped& is_dropped);

}  // namespace mw::engine
