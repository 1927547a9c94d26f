// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What final blocks tell one by one, whichever process reads them in whatever order.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/output/finish.h"
#include "engine/output/longest_edges.h"

namespace mw::engine {

/// Figures of what is written: sums of whole numbers, and extremes.
/// Memory: 24 bytes a label.
struct BlockFigures {
  std::optional<audit::QualityMeter> quality;
  std::optional<LongestEdges> edges;
  bool has_volumes = false;
  std::vector<Int128> volumes6;  ///< by dense label; see FinishedMesh

  /// labels: how many there are.
  BlockFigures(const OutputOptions& options, std::size_t labels);

  /// block: without what is not written; positions of its vertices; tets: its own, as they are
  /// written, but by rows of the block; first_tet: the number of the first one in the mesh.
  void add(const BlockMesh& block, std::span<const io::Position> positions,
           std::span<const io::TetRows> tets, std::uint64_t first_tet);

  /// Ends it.
  void report(FinishedMesh& out);
};

}  // namespace mw::engine
