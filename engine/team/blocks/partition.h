// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which process visits which window.
#pragma once

#include <span>
#include <vector>

#include "engine/store/run_layout.h"

namespace mw::engine {

/// Deals the windows of a run to processes ("ranks").  Rows along x stay whole, and later marches
/// follow the first one's cuts, so that most blocks stay where they are.
///
/// kColour: bricks of rows, cut in two again and again, across the longer side, where half of the
/// cost is on each side: an eighth of all windows may run at once anywhere, so volumes with little
/// surface are best.  kRaster: the wave passes bricks one by one, so tiles of 8 x 8 rows are dealt
/// out by turns.
///
/// Nothing here changes the result.
class Partition {
 public:
  /// Everything to one process.
  Partition() = default;
  /// row_costs: of the first march's rows, y fastest; empty: all alike.
  /// REQUIRES: ranks >= 1; none of the costs negative.
  Partition(const RunLayout& layout, Order order, int ranks,
            std::span<const double> row_costs = {});
  /// From owners(), for processes that are told rather than count.
  /// REQUIRES: as many as the first march has rows.
  Partition(const RunLayout& layout, std::vector<std::uint32_t> owners);

  [[nodiscard]] int rank_of(const WindowKey& key) const;
  /// Ranks by row of the first march, y fastest.
  [[nodiscard]] const std::vector<std::uint32_t>& owners() const { return owners_; }

 private:
  std::int64_t rows_y_ = 1;
  std::int64_t rows_z_ = 1;
  std::vector<std::uint32_t> owners_{0};
};

}  // namespace mw::engine
