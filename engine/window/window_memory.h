// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How much memory each part of a run takes, estimated before the part starts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "engine/labels/label_need.h"
#include "engine/settings/settings.h"
#include "engine/window/block_store.h"
#include "kernels/start/graded_start.h"

namespace mw::engine {

/// Returns the size of a block that is made from voxels.
using StartSizeOf = std::function<StartSize(Index3 block)>;

/// What visits of one march need to know beside what is stored.
struct WindowNeeds {
  StartSizeOf start_size;
  std::optional<double> max_distance;  ///< in voxels: how far around the content labels are read
  bool has_source = false;             ///< a source surface is read there, too
};

/// Returns an upper bound on what a visit allocates, from the content that it begins with: blocks
/// as they are stored, those that are made from voxels, and the labels around them.  It holds for
/// every kind of volume, start mesh and bound on the distance (tests/engine/memory).
[[nodiscard]] std::uint64_t window_bytes(const WindowGrid& grid, Index3 window,
                                         const BlockStore& store, const WindowNeeds& needs);

/// Returns the largest size of a block for any labels.
[[nodiscard]] StartSize max_start_size(const WindowGrid& grid, Index3 block);

/// Returns how many voxels around a window of the grid the labels for the distance bound are read;
/// in rare cases they are read farther out.
[[nodiscard]] std::int64_t content_halo(const WindowGrid& grid, double max_distance);

/// Returns what windows of usual labels take at most; noise takes more.  sized says that edges have
/// limits.
[[nodiscard]] std::uint64_t usual_window_bytes(const WindowGrid& grid, bool sized);

/// True if twice as many windows as run at a time fit, whatever the labels are.  Then sizes need
/// not be exact, and freed memory may stay with the allocator.  (Exact sizes and giving memory back
/// cost 10 % of the time on EM 128^3: 28 instead of 25 s.)
[[nodiscard]] bool budget_is_ample(std::uint64_t memory, const WindowGrid& grid, int threads);

/// Returns what the program takes all the time: code, libraries, threads, the allocator's slack,
/// the label table.
[[nodiscard]] std::uint64_t program_bytes(std::size_t labels, int threads);

/// Returns what PreparedLabels holds for a volume of this shape; sized says that edges have limits.
[[nodiscard]] std::uint64_t prepared_label_bytes(Index3 shape, bool sized = false);
/// Returns what PreparedLabels holds when it prepares only these bricks of the volume.
[[nodiscard]] std::uint64_t prepared_label_bytes(const NeededBricks& share, Index3 shape,
                                                 bool sized = false);
/// Returns what the places of bricks in a file take: of a source surface, or of labels.
[[nodiscard]] std::uint64_t brick_place_bytes(Index3 shape);
/// Returns what PreparedLabels takes in addition while it is made.  has_scores says that labels
/// come from scores.
[[nodiscard]] std::uint64_t preparation_bytes(const MeshSettings& settings,
                                              bool has_scores = false);

/// Returns what it takes to write a block of the finished mesh that has `loaded` bytes in memory.
[[nodiscard]] std::uint64_t written_block_bytes(std::uint64_t loaded);

}  // namespace mw::engine
