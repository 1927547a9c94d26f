// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which process has which of the final blocks, when the output is written together.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/team/block_route.h"
#include "engine/team/partition.h"

namespace mw::engine {

/// By line of blocks of the last march (those of one y and z; y fastest): the rank that visits its
/// first block last.  Rows of windows are whole, so that rank has nearly always visited the whole
/// line last, and the blocks stay where they are.  Pure.
[[nodiscard]] std::vector<std::uint32_t> line_owners(const RunLayout& layout,
                                                     const Partition& partition);

}  // namespace mw::engine
