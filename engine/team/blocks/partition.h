// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Decides which process visits which window.
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
  std::vector<WindowGrid> grids_;  ///< one for each march; none if there is one process
  std::int64_t rows_y_ = 1;
  std::int64_t rows_z_ = 1;
  std::vector<std::uint32_t> owners_{0};
};

}  // namespace mw::engine
