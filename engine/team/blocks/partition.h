// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Decides which process visits which window, and which of the final blocks are a process's own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/store/run_layout.h"
#include "kernels/core/index.h"

namespace mw::engine {

/// Deals the windows of a run to processes ("ranks").  Rows along x stay whole, and later marches
/// follow the first one's cuts, so that most blocks stay where they are.
///
/// With kColour each rank gets a brick of rows.  Bricks are cut in two again and again, across the
/// longer side, where each side has its share of the cost: an eighth of all windows may run at
/// once, wherever they are, so volumes with little surface are best.  With kRaster the wave would
/// pass bricks one by one, so ranks take turns in tiles of 8 x 8 rows.
///
/// Nothing here changes the result.
class Partition {
 public:
  /// Deals all windows to one process.
  Partition() = default;
  /// row_costs are the costs of the first march's rows, y fastest; empty if all are equal.
  /// REQUIRES: ranks >= 1; no cost is negative.
  Partition(const RunLayout& layout, Order order, int ranks,
            std::span<const double> row_costs = {});
  /// Takes the owners() that another process computed.
  /// REQUIRES: there are as many as the first march has rows.
  Partition(const RunLayout& layout, std::vector<std::uint32_t> owners);

  [[nodiscard]] int rank_of(const WindowKey& key) const;
  /// Returns the rank of each row of the first march, y fastest.
  [[nodiscard]] const std::vector<std::uint32_t>& owners() const { return owners_; }

 private:
  std::int64_t rows_y_ = 1;
  std::int64_t rows_z_ = 1;
  std::vector<std::uint32_t> owners_{0};
};

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
