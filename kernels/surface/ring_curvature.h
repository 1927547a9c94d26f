// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The curvature that a vertex has by those around it.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

namespace mw {

/// The curvature of a ring: the mean of its values cut at `most`, since a step in smooth
/// surroundings is no shape.  Threads and rims are.  On a thread all values exceed `most` in the
/// same direction, and the least of them counts.  On the rim of a plate two neighbours, those along
/// the rim, bend sharply, and none bends the other way; the lesser of the two counts.
class RingCurvature {
 public:
  explicit RingCurvature(double most) : most_(most) {}

  void add(std::optional<double> known) {
    if (known) values_.push_back(*known);
  }
  /// Returns 0 where no curvature is known.
  [[nodiscard]] double value() {
    if (values_.empty()) return 0.0;
    std::sort(values_.begin(), values_.end());
    if (values_.front() > most_) return values_.front();
    if (values_.back() < -most_) return values_.back();
    if (values_.size() > kOfOne) {
      const double second = values_[values_.size() - 1 - kOfOne], last_but_one = values_[kOfOne];
      if (second > kSharp && values_.front() > -kOtherWay) return second;
      if (last_but_one < -kSharp && values_.back() < kOtherWay) return last_but_one;
    }
    return cut_mean();
  }

 private:
  /// How often a neighbour's value is there, as it is at two of the triangles in general.
  static constexpr std::size_t kOfOne = 2;
  /// The curvature of a rim at least, and of its ring the other way at most, 1 / voxel
  /// (bench/parameters.md, "Constants").
  static constexpr double kSharp = 0.5, kOtherWay = 0.3;

  [[nodiscard]] double cut_mean() const {
    double sum = 0.0;
    for (const double value : values_) sum += std::clamp(value, -most_, most_);
    return sum / static_cast<double>(values_.size());
  }

  double most_;
  std::vector<double> values_;
};

}  // namespace mw
