// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How much memory a window takes while it is in flight, told before it starts.
#pragma once

#include <cstdint>

#include "engine/block_store.h"
#include "io/labels/label_table.h"

namespace mw::engine {

/// An upper bound, from the content of its stored blocks and the voxels of the others.
[[nodiscard]] std::uint64_t window_bytes(const WindowGrid& grid, Index3 window,
                                         const BlockStore& store);

/// The same for a window with no stored block; there is no larger one in the first march.
[[nodiscard]] std::uint64_t start_window_bytes(const WindowGrid& grid);

/// What the program takes beside windows: code, libraries, the label table, prepared labels.
[[nodiscard]] std::uint64_t program_bytes(const io::DenseVolume& volume);

}  // namespace mw::engine
