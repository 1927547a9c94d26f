// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Vertices that a process's blocks reference and that lie at home in another one's line.
#pragma once

#include <span>
#include <vector>

#include "engine/output/remembered.h"
#include "engine/output/vertex_rows.h"
#include "engine/team/output/line_share.h"

namespace mw::engine {

/// Says that a process references a vertex.  Blocks are given by raster number.
struct Claim {
  std::uint64_t home = 0;  ///< the block in whose box the vertex lies
  VertexId id = 0;
  std::uint64_t first = 0;  ///< the first of the process's blocks that reference it

  friend bool operator==(const Claim&, const Claim&) = default;
};

[[nodiscard]] inline bool is_before(const Claim& a, std::uint64_t home, VertexId id) {
  return a.home != home ? a.home < home : a.id < id;
}

/// Collects the claims of one process while its blocks are read.
/// Memory: 144 bytes for each vertex that is claimed.
class Claims {
 public:
  /// The references outlive it.
  Claims(const LineShare& share, const VertexUses& homes, HoldMemory hold)
      : share_(share), homes_(homes), hold_(std::move(hold)) {}

  /// Adds the vertices of a block; blocks may come in any order.
  void add(Index3 block, std::span<const BlockVertex> vertices);
  /// Returns the claims by the owner of the home, ascending by home and id, each vertex once.
  [[nodiscard]] std::vector<std::vector<Claim>> take(std::size_t ranks);

 private:
  void make_room(std::size_t more);
  void compact();

  const LineShare& share_;
  const VertexUses& homes_;
  HoldMemory hold_;
  std::vector<Claim> list_;
};

}  // namespace mw::engine
