// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Gives each vertex of a block its row in the finished mesh, without a list of all vertices.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/window/window_grid.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

// A vertex rests in every block that references it.  The first of them in raster order gives it a
// row, and the later ones must find that row.  All copies agree on the position, hence on the
// vertex's home: the block in whose box it lies, whether or not that block references it.  A first
// pass notes until when each line of homes (the blocks of one y and z) is asked for; the second
// gives out rows and then forgets the line.

/// The first pass: for each line of homes, the last line of blocks that references a vertex there.
class VertexUses {
 public:
  explicit VertexUses(const WindowGrid& grid);

  /// Returns the lines of the vertices' homes, ascending.  May be called while add() runs.
  [[nodiscard]] std::vector<std::size_t> lines_of(std::span<const BlockVertex> vertices) const;
  /// lines are what lines_of() returned for the vertices of the block.
  void add(Index3 block, std::span<const std::size_t> lines);

  [[nodiscard]] Index3 blocks() const { return blocks_; }
  /// Returns the block in whose box a position lies; for far faces of the volume, the last block.
  [[nodiscard]] Index3 home(Point position) const;
  /// Returns the number of the line of a block.
  [[nodiscard]] std::size_t line(Index3 block) const {
    return static_cast<std::size_t>(block.z * blocks_.y + block.y);
  }
  /// Returns the last line that references it, by line of homes; 0 if no line does.
  [[nodiscard]] std::span<const std::size_t> last_lines() const { return last_line_; }

 private:
  Index3 blocks_;
  Index3 block_shape_;  ///< lattice units
  std::vector<std::size_t> last_line_;
};

/// The second pass: rows ascend by first block, then by id, so they depend on the blocks alone.
///
/// Memory: 16 bytes for each vertex of the homes that are alive, and some 50 for each line.  When
/// no block references a vertex at home more than r blocks away along any axis (r is 1 or 2 in
/// practice), at most 2 r (blocks.y + 1) + 1 lines are alive: about 2 r planes of blocks, however
/// many planes there are.
class VertexRows {
 public:
  /// REQUIRES: uses knows all blocks.
  explicit VertexRows(VertexUses uses);

  /// Returns the row of each vertex.  Rows that are not below count() before the call are new, and
  /// ascend.  REQUIRES: each block once, in raster order, with the vertices of the first pass,
  /// ascending by id.  Cost: O(log) a vertex.
  [[nodiscard]] std::vector<std::uint64_t> assign(Index3 block,
                                                  std::span<const BlockVertex> vertices);

  /// Returns the number of rows given out so far.
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Return the number of vertices that are remembered, and the most so far.
  [[nodiscard]] std::size_t remembered() const { return remembered_; }
  [[nodiscard]] std::size_t max_remembered() const { return max_remembered_; }

 private:
  struct Entry {
    VertexId id = 0;
    std::uint64_t row = 0;
  };
  using Home = std::vector<Entry>;  ///< ascending by id

  [[nodiscard]] const Entry* find(std::size_t home, VertexId id) const;
  void remember(std::size_t home, const Home& added);
  void forget_after(std::size_t line);

  VertexUses uses_;
  std::vector<std::vector<std::size_t>> lines_to_forget_;  ///< what to forget after each line
  std::unordered_map<std::size_t, Home> homes_;            ///< by raster number of the block
  std::uint64_t count_ = 0;
  std::size_t remembered_ = 0;
  std::size_t max_remembered_ = 0;
};

}  // namespace mw::engine
