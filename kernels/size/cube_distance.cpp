// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One axis after the other, each line by the lower envelope of parabolas (Felzenszwalb and
// Huttenlocher, Distance Transforms of Sampled Functions, 2012).
#include "kernels/size/cube_distance.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace mw {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// A line of the grid.
class Line {
 public:
  Line(std::size_t cubes, double edge) : in_(cubes), step2_(edge * edge) {}

  void take(std::span<const float> from, std::size_t first, std::size_t stride) {
    for (std::size_t i = 0; i < in_.size(); ++i) in_[i] = from[first + i * stride];
  }

  /// The least in_[j] + (gap between i and j)^2 over all j, for each i, to `to`.
  void spread(std::span<float> to, std::size_t first, std::size_t stride) {
    widen();
    find_envelope();
    std::size_t at = 0;
    for (std::size_t i = 0; i < in_.size(); ++i) {
      while (at + 1 < lowest_.size() && lowest_[at + 1].from < static_cast<double>(i)) ++at;
      const double value = lowest_.empty() ? kFar : parabola(lowest_[at].apex, i);
      to[first + i * stride] = static_cast<float>(value);
    }
  }

 private:
  /// An apex whose parabola is lowest from `from` on.
  struct Stretch {
    std::size_t apex = 0;
    double from = 0.0;
  };

  /// A gap of boxes is one cube less than that of their places: what is marked grows by one.
  void widen() {
    wide_ = in_;
    for (std::size_t i = 0; i + 1 < in_.size(); ++i) {
      wide_[i] = std::min(wide_[i], in_[i + 1]);
      wide_[i + 1] = std::min(wide_[i + 1], in_[i]);
    }
  }

  void find_envelope() {
    lowest_.clear();
    for (std::size_t i = 0; i < wide_.size(); ++i) {
      if (wide_[i] == kFar) continue;
      double from = -kFar;
      while (!lowest_.empty()) {
        from = crossing(lowest_.back().apex, i);
        if (from > lowest_.back().from) break;
        lowest_.pop_back();
        from = -kFar;
      }
      lowest_.push_back({i, from});
    }
  }

  [[nodiscard]] double parabola(std::size_t apex, std::size_t i) const {
    const double way = static_cast<double>(i) - static_cast<double>(apex);
    return wide_[apex] + step2_ * way * way;
  }

  /// Where the parabola of the later apex comes to be the lower one.
  [[nodiscard]] double crossing(std::size_t earlier, std::size_t later) const {
    const auto a = static_cast<double>(earlier), b = static_cast<double>(later);
    return ((wide_[later] - wide_[earlier]) / step2_ + b * b - a * a) / (2.0 * (b - a));
  }

  std::vector<double> in_;
  std::vector<double> wide_;
  double step2_;
  std::vector<Stretch> lowest_;
};

}  // namespace

void spread_squared_gaps(Index3 cubes, const Vec3& edges, std::span<float> squared) {
  const std::array<std::size_t, 3> sizes{static_cast<std::size_t>(cubes.x),
                                         static_cast<std::size_t>(cubes.y),
                                         static_cast<std::size_t>(cubes.z)};
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Line line(sizes[axis], edges[static_cast<int>(axis)]);
    const std::size_t plane = stride * sizes[axis];
    for (std::size_t first = 0; first < squared.size(); ++first) {
      if (first / stride % sizes[axis] != 0) continue;
      line.take(squared, first, stride);
      line.spread(squared, first, stride);
    }
    stride = plane;
  }
}

}  // namespace mw
