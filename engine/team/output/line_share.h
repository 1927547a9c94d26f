// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which of the final blocks are a process's own, where several write the mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/store/block_route.h"
#include "engine/team/blocks/partition.h"
#include "kernels/core/index.h"

namespace mw::engine {

/// Lines of blocks (those of one y and z) by number, y fastest; each has an owner, one of the
/// processes ("ranks").  Pure.
class LineShare {
 public:
  /// owners has the rank of each of the blocks.y * blocks.z lines; own lines are those of `rank`.
  LineShare(Index3 blocks, std::vector<std::uint32_t> owners, std::uint32_t rank)
      : blocks_(blocks), owners_(std::move(owners)), rank_(rank) {}

  [[nodiscard]] Index3 blocks() const { return blocks_; }
  [[nodiscard]] std::size_t lines() const { return owners_.size(); }
  [[nodiscard]] std::uint32_t owner(std::size_t line) const { return owners_[line]; }
  [[nodiscard]] bool is_own(std::size_t line) const { return owners_[line] == rank_; }
  /// Returns the line of a block that is given by its raster number.
  [[nodiscard]] std::size_t line_of(std::uint64_t block) const {
    return static_cast<std::size_t>(block) / static_cast<std::size_t>(blocks_.x);
  }
  /// Returns the first block of a line.
  [[nodiscard]] Index3 first_block(std::size_t line) const {
    const auto number = static_cast<std::int64_t>(line);
    return {0, number % blocks_.y, number / blocks_.y};
  }

 private:
  Index3 blocks_;
  std::vector<std::uint32_t> owners_;
  std::uint32_t rank_;
};

/// Calls visit_line(line) for each own line, and then visit_block(block) for its blocks, ascending.
template <typename VisitLine, typename VisitBlock>
void for_each_own_block(const LineShare& share, VisitLine visit_line, VisitBlock visit_block) {
  for (std::size_t line = 0; line < share.lines(); ++line) {
    if (!share.is_own(line)) continue;
    visit_line(line);
    Index3 block = share.first_block(line);
    for (; block.x < share.blocks().x; ++block.x) visit_block(block);
  }
}

/// Returns for each line of blocks of the last march (those of one y and z; y fastest) the rank
/// that visits its first block last.  Rows of windows are whole, so this rank has nearly always
/// visited the whole line last, and the blocks stay where they are.  Pure.
[[nodiscard]] std::vector<std::uint32_t> line_owners(const RunLayout& layout,
                                                     const Partition& partition);

}  // namespace mw::engine
