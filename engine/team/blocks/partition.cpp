// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Deals bricks of rows by halving, or tiles of rows by turns.
#include "engine/team/blocks/partition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

constexpr std::int64_t kTile = 8;  ///< rows of a tile along each axis

/// Rows with y0 <= y < y1 and z0 <= z < z1.
struct Rows {
  std::int64_t y0, z0, y1, z1;
};

class Halving {
 public:
  Halving(std::int64_t rows_y, std::int64_t rows_z, std::span<const double> costs)
      : rows_y_(rows_y), costs_(costs), owners_(static_cast<std::size_t>(rows_y * rows_z)) {}

  void deal(const Rows& rows, std::uint32_t first, std::uint32_t ranks) {
    const bool across_z = rows.z1 - rows.z0 >= rows.y1 - rows.y0;
    const std::int64_t length = across_z ? rows.z1 - rows.z0 : rows.y1 - rows.y0;
    if (ranks == 1 || length <= 1) return give(rows, first);
    const std::uint32_t lower = ranks / 2;
    const std::int64_t cut = best_cut(rows, across_z, static_cast<double>(lower) / ranks);
    Rows low = rows, high = rows;
    (across_z ? low.z1 : low.y1) = cut;
    (across_z ? high.z0 : high.y0) = cut;
    deal(low, first, lower);
    deal(high, first + lower, ranks - lower);
  }

  [[nodiscard]] std::vector<std::uint32_t> take() { return std::move(owners_); }

 private:
  [[nodiscard]] std::size_t index(std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>(z * rows_y_ + y);
  }
  [[nodiscard]] double cost(const Rows& rows) const {
    double sum = 0;
    for (std::int64_t z = rows.z0; z < rows.z1; ++z) {
      for (std::int64_t y = rows.y0; y < rows.y1; ++y) {
        sum += costs_.empty() ? 1.0 : costs_[index(y, z)];
      }
    }
    return sum;
  }
  void give(const Rows& rows, std::uint32_t rank) {
    for (std::int64_t z = rows.z0; z < rows.z1; ++z) {
      for (std::int64_t y = rows.y0; y < rows.y1; ++y) owners_[index(y, z)] = rank;
    }
  }
  /// Returns where the lower part's cost is nearest to that share; neither part is empty.  A brick
  /// whose first layer is odd waits for the last layer of the brick below, in the colour order of
  /// this march or, at twice an odd number, of the next.  Its look-ahead then fills with windows
  /// that wait, which costs up to half of the speed in simulations (bench/scaling).  So cuts are at
  /// multiples of 4, else of 2, where that leaves the shares within a tenth.
  [[nodiscard]] std::int64_t best_cut(const Rows& rows, bool across_z, double share) const {
    const double all = cost(rows), wanted = share * all;
    for (const std::int64_t step : {4, 2}) {
      const Cut cut = nearest_cut(rows, across_z, wanted, step);
      if (cut.off <= 0.1 * std::min(wanted, all - wanted)) return cut.at;
    }
    return nearest_cut(rows, across_z, wanted, 1).at;
  }

  struct Cut {
    std::int64_t at = 0;
    double off = std::numeric_limits<double>::infinity();  ///< distance from the wanted cost
  };

  /// Returns the multiple of `step` below which the cost is nearest to the wanted one.
  [[nodiscard]] Cut nearest_cut(const Rows& rows, bool across_z, double wanted,
                                std::int64_t step) const {
    const std::int64_t lo = across_z ? rows.z0 : rows.y0, hi = across_z ? rows.z1 : rows.y1;
    Cut best;
    double sum = 0;
    for (std::int64_t i = lo; i + 1 < hi; ++i) {
      Rows slice = rows;
      (across_z ? slice.z0 : slice.y0) = i;
      (across_z ? slice.z1 : slice.y1) = i + 1;
      sum += cost(slice);
      const double off = std::abs(sum - wanted);
      if ((i + 1) % step == 0 && off < best.off) best = {i + 1, off};
    }
    return best;
  }

  std::int64_t rows_y_;
  std::span<const double> costs_;
  std::vector<std::uint32_t> owners_;
};

std::vector<std::uint32_t> tiles_by_turns(std::int64_t rows_y, std::int64_t rows_z,
                                          std::uint32_t ranks) {
  const std::int64_t tiles_y = (rows_y + kTile - 1) / kTile;
  std::vector<std::uint32_t> out;
  for (std::int64_t z = 0; z < rows_z; ++z) {
    for (std::int64_t y = 0; y < rows_y; ++y) {
      const std::int64_t tile = z / kTile * tiles_y + y / kTile;
      out.push_back(static_cast<std::uint32_t>(tile % ranks));
    }
  }
  return out;
}

std::vector<WindowGrid> grids_of(const RunLayout& layout) {
  std::vector<WindowGrid> out;
  for (std::uint32_t march = 0; march < layout.marches(); ++march)
    out.push_back(layout.grid(march));
  return out;
}

}  // namespace

Partition::Partition(const RunLayout& layout, Order order, int ranks,
                     std::span<const double> row_costs)
    : grids_(grids_of(layout)),
      rows_y_(layout.grid(0).windows().y),
      rows_z_(layout.grid(0).windows().z) {
  MW_ASSERT(ranks >= 1);
  MW_ASSERT(row_costs.empty() || row_costs.size() == static_cast<std::size_t>(rows_y_ * rows_z_));
  const auto count = static_cast<std::uint32_t>(ranks);
  if (order == Order::kRaster) {
    owners_ = tiles_by_turns(rows_y_, rows_z_, count);
  } else {
    Halving halving(rows_y_, rows_z_, row_costs);
    halving.deal({0, 0, rows_y_, rows_z_}, 0, count);
    owners_ = halving.take();
  }
}

Partition::Partition(const RunLayout& layout, std::vector<std::uint32_t> owners)
    : grids_(grids_of(layout)),
      rows_y_(layout.grid(0).windows().y),
      rows_z_(layout.grid(0).windows().z),
      owners_(std::move(owners)) {
  MW_ASSERT(owners_.size() == static_cast<std::size_t>(rows_y_ * rows_z_));
}

/// A window of a later march belongs to the rank of the first march's row in its middle.
int Partition::rank_of(const WindowKey& key) const {
  if (grids_.empty()) return static_cast<int>(owners_[0]);
  const WindowGrid& grid = grids_[key.march];
  const std::int64_t times = grid.block_edge() / grids_[0].block_edge();
  const auto row_along = [&](unsigned axis, std::int64_t rows) {
    const std::int64_t first = along(grid.first(), axis), blocks = along(grid.blocks(), axis);
    std::int64_t upper = along(key.window, axis) + 1 + first;
    if (first > 0) upper %= blocks;
    return std::clamp<std::int64_t>(times * upper - 1, 0, rows - 1);
  };
  const std::int64_t row = row_along(2, rows_z_) * rows_y_ + row_along(1, rows_y_);
  return static_cast<int>(owners_[static_cast<std::size_t>(row)]);
}

}  // namespace mw::engine
