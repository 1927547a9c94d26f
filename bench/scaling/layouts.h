// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Runs without voxels: their grids, and who gets which rows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/scaling/run_flow.h"
#include "bench/scaling/trace_table.h"
#include "engine/team/blocks/partition.h"

namespace mw::bench {

/// The layout of a run over a volume of this shape; each march has windows twice as large.
[[nodiscard]] engine::RunLayout run_layout(Index3 volume, int window, std::uint32_t marches,
                                           engine::Order order);

/// The layout of a traced run, of blocks of one voxel.
[[nodiscard]] engine::RunLayout traced_layout(const std::vector<MarchTrace>& trace,
                                              engine::Order order);

/// Deals rows as the engine would if its forecast were exact: costs of rows are their seconds.
/// cut_every: colour bricks end where rows of the first march are a multiple of it; the engine: 1.
[[nodiscard]] engine::Partition deal(const RunFlow& flow, std::span<const double> seconds,
                                     engine::Order order, int ranks, std::int64_t cut_every = 1);

/// Deals `volume` as the engine does where all rows cost the same; then each row of the flow
/// belongs to the rank that has the row at its relative place in the volume.
[[nodiscard]] engine::Partition deal_like(const RunFlow& flow, const engine::RunLayout& volume,
                                          engine::Order order, int ranks);

}  // namespace mw::bench
