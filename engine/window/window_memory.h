// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How much memory each part of a run takes, told before it starts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "engine/labels/label_need.h"
#include "engine/settings/settings.h"
#include "engine/window/block_store.h"
#include "kernels/start/graded_start.h"

namespace mw::engine {

/// The size of a block that is made from voxels.
using StartSizeOf = std::function<StartSize(Index3 block)>;

/// What visits of one march need to know beside what is stored.
struct WindowNeeds {
  StartSizeOf start_size;
  std::optional<double> max_distance;  ///< in voxels; labels are read so far around the content
  bool has_source = false;             ///< and a source surface is read as well
};

/// An upper bound on what a visit allocates, by the content that it begins with: blocks as they are
/// stored, those that are made from voxels, and the labels around them.  It holds for every kind of
/// volume, start mesh and bound on the distance (tests/engine/memory).
[[nodiscard]] std::uint64_t window_bytes(const WindowGrid& grid, Index3 window,
                                         const BlockStore& store, const WindowNeeds& needs);

/// Returns the largest size of a block for any labels.
[[nodiscard]] StartSize max_start_size(const WindowGrid& grid, Index3 block);

/// Returns how many voxels around a window of the grid the labels for the distance bound are
/// asked for, with rare exceptions farther out.
[[nodiscard]] std::int64_t content_halo(const WindowGrid& grid, double max_distance);

/// Whether this many windows at a time fit many times over, whatever the labels are: then sizes
/// need not be exact, and freed memory may stay with the allocator.  (Both cost 10 % of the time
/// on EM 128^3: 28 instead of 25 s.)
[[nodiscard]] bool budget_is_ample(std::uint64_t memory, const WindowGrid& grid, int threads);

/// What the program takes all the time: code, libraries, threads, the allocator's slack, the label
/// table.
[[nodiscard]] std::uint64_t program_bytes(std::size_t labels, int threads);

/// What PreparedLabels holds of a volume of this shape; sized: with limits on edges.
[[nodiscard]] std::uint64_t prepared_label_bytes(Index3 shape, bool sized = false);
/// What PreparedLabels holds when it prepares only these bricks of the volume.
[[nodiscard]] std::uint64_t prepared_label_bytes(const NeededBricks& share, Index3 shape,
                                                 bool sized = false);
/// The places of a source surface in its file, which labels with scores have beside all that.
[[nodiscard]] std::uint64_t source_place_bytes(Index3 shape);
/// What it takes in addition while it is made.  has_scores: labels come from scores.
[[nodiscard]] std::uint64_t preparation_bytes(const MeshSettings& settings,
                                              bool has_scores = false);

/// What it takes to write a block of the finished mesh.  `loaded`: its bytes in memory.
[[nodiscard]] std::uint64_t written_block_bytes(std::uint64_t loaded);

}  // namespace mw::engine
