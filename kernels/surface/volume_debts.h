// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What vertices could not do for the volumes of their labels, so that their neighbours can.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/core/label.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Volume that a vertex leaves between the input's faces and the interface of labels low < high.
struct VolumeDebt {
  Label low = 0;
  Label high = 0;
  double volume = 0.0;  ///< what low lacks and high has too much of, for each triangle there
};

/// The debts that vertices had after their last visit.
class VolumeDebts {
 public:
  void set(LocalVertex v, std::span<const VolumeDebt> debts) {
    if (v >= rows_.size()) rows_.resize(std::size_t{v} + 1, kNone);
    if (rows_[v] == kNone) {
      rows_[v] = static_cast<std::uint32_t>(lists_.size());
      lists_.emplace_back();
    }
    lists_[rows_[v]].assign(debts.begin(), debts.end());
  }
  /// Returns a debt per triangle; 0 at vertices that were not visited.
  [[nodiscard]] double of(LocalVertex v, Label low, Label high) const {
    if (v >= rows_.size() || rows_[v] == kNone) return 0.0;
    for (const VolumeDebt& d : lists_[rows_[v]]) {
      if (d.low == low && d.high == high) return d.volume;
    }
    return 0.0;
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::vector<std::uint32_t> rows_;  ///< row in lists_ of each vertex
  std::vector<std::vector<VolumeDebt>> lists_;
};

}  // namespace mw
