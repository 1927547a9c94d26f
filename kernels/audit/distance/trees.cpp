// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Packing and descending the trees.
#include "kernels/audit/distance/trees.h"

#include <algorithm>
#include <cmath>

namespace mw::audit {

LabelTrees::Box LabelTrees::widened(const Extent& extent) {
  constexpr double kWidening = 1e-6;  // rounding to float moves a number by 6e-8 of it at most
  Box box{};
  for (std::size_t k = 0; k < 3; ++k) {
    box.lo[k] = static_cast<float>(extent.lo[k] - kWidening * (1 + std::abs(extent.lo[k])));
    box.hi[k] = static_cast<float>(extent.hi[k] + kWidening * (1 + std::abs(extent.hi[k])));
  }
  return box;
}

void LabelTrees::add_levels() {
  if (level_begin_.back() == levels_.size()) return;
  while (levels_.back().count > 1) {
    const Level below = levels_.back();
    const Level level{boxes_.size(), (below.count + kFan - 1) / kFan};
    for (std::uint64_t first = 0; first < below.count; first += kFan) {
      Box all = boxes_[below.begin + first];
      const std::uint64_t end = std::min(first + kFan, below.count);
      for (std::uint64_t i = first + 1; i < end; ++i) all = joined(all, boxes_[below.begin + i]);
      boxes_.push_back(all);
    }
    levels_.push_back(level);
  }
}

}  // namespace mw::audit
