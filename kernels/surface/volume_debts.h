// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What vertices could not do for the volumes of their labels, so that their neighbours can.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
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

/// The debts of vertices that were visited, each by its last visit.
class VolumeDebts {
 public:
  void set(LocalVertex v, std::span<const VolumeDebt> debts) {
    of_[v].assign(debts.begin(), debts.end());
  }
  /// 0 at vertices that were not visited.
  [[nodiscard]] double of(LocalVertex v, Label low, Label high) const {
    const auto found = of_.find(v);
    if (found == of_.end()) return 0.0;
    for (const VolumeDebt& d : found->second) {
      if (d.low == low && d.high == high) return d.volume;
    }
    return 0.0;
  }

 private:
  std::unordered_map<LocalVertex, std::vector<VolumeDebt>> of_;  ///< for look-ups only
};

}  // namespace mw
