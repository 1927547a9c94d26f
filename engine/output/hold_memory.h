// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How the merge tells a budget what it is about to remember.
#pragma once

#include <cstdint>
#include <functional>

namespace mw::engine {

/// Told how many bytes are remembered, before that grows beyond what was last told; may throw.
using HoldMemory = std::function<void(std::uint64_t bytes)>;

}  // namespace mw::engine
