// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which bytes of a folder go first when it has to become smaller.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/store/run_layout.h"

namespace mw::engine {

/// A window whose bytes are kept.
struct KeptBytes {
  std::uint64_t window = 0;
  std::uint32_t run = 0;    ///< the run that visited it
  std::uint64_t bytes = 0;  ///< what it takes of the file
};

/// True if the output reads a block as this window leaves it; such bytes are never given up, since
/// every later run reads them.
[[nodiscard]] bool leaves_final_block(const RunLayout& layout, const WindowKey& key);

/// Returns those that may be given up, in the order in which they go: windows of the earliest runs
/// first, among these the farthest from the box that the last run visited, then the last window.
[[nodiscard]] std::vector<KeptBytes> drop_order(const RunLayout& layout,
                                                std::vector<KeptBytes> kept,
                                                std::uint32_t last_run);

}  // namespace mw::engine
