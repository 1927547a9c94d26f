// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The numbers that the labels of a volume were found from.
#pragma once

#include <cstddef>
#include <span>

#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw::io {

/// A score for each label and voxel.  The label of a voxel is the one of the highest score, and the
/// smallest of several, so that two labels meet where their scores are equal.
/// Thread safety: const members may be called from many threads.
class LabelScores {
 public:
  virtual ~LabelScores() = default;
  [[nodiscard]] virtual Index3 shape() const = 0;
  /// Labels are 0 to labels() - 1.
  [[nodiscard]] virtual std::size_t labels() const = 0;
  /// Reads the scores of a label, x fastest.  REQUIRES: what LabelVolume::read() requires.
  virtual void read_scores(RawLabel label, const Box3& box, std::span<double> out) const = 0;
};

}  // namespace mw::io
