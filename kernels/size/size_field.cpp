// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cubes with listed labels, and a distance transform for each limit.
#include "kernels/size/size_field.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "kernels/core/index.h"
#include "kernels/core/sort_distinct.h"

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

  /// Writes the least in_[j] + (gap between i and j)^2 over all j, for each i, to `to`.
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

  /// Boxes are one cube nearer to each other than their places, so what is marked grows by one.
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

constexpr float kUnlimited = std::numeric_limits<float>::infinity();

float rounded_down(double value) {
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) > value ? std::nextafter(near, 0.0F) : near;
}

/// Beyond this number limits are rounded to rungs before they are spread.
constexpr std::size_t kMostLimits = 64;

constexpr double kWidestStep = 1.05;

/// Returns the largest power of the step that is no larger than the limit.
double rung_of(double step, double limit) {
  double rung = 1.0;
  while (rung > limit) rung /= step;
  while (rung * step <= limit) rung *= step;
  return rung;
}

/// Returns the narrowest of some steps that leaves few limits, if one does, else the widest.
double step_for(double least, double most) {
  for (const double step : {1.0125, 1.025}) {
    std::size_t rungs = 1;
    for (double rung = rung_of(step, least); rung * step <= most; rung *= step) ++rungs;
    if (rungs <= kMostLimits) return step;
  }
  return kWidestStep;
}

/// Returns the values that occur, ascending.
std::vector<float> distinct(std::vector<float> values) {
  sort_distinct(values);
  return values;
}

Index3 cubes_of(Index3 volume, std::int64_t edge) {
  const auto along = [edge](std::int64_t n) { return (n + edge - 1) / edge; };
  return {along(volume.x), along(volume.y), along(volume.z)};
}

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

std::int64_t SizeField::cube_voxels(Index3 volume) {
  constexpr std::int64_t kLargest = 8, kMaxCubes = 1 << 21;
  std::int64_t edge = 1;
  while (edge < kLargest && cubes_of(volume, edge).product() > kMaxCubes) edge *= 2;
  return edge;
}

std::uint64_t SizeField::making_bytes(Index3 volume) {
  return 16 * static_cast<std::uint64_t>(cubes_of(volume, cube_voxels(volume)).product());
}

SizeField::SizeField(Index3 volume, const Metric& metric, std::vector<double> label_limits,
                     double gradation, bool by_voxel)
    : cube_(cube_voxels(volume)),
      cube_shift_(std::countr_zero(static_cast<std::uint64_t>(cube_ * kUnitsPerVoxel))),
      cubes_(cubes_of(volume, cube_)),
      cube_edges_(metric.voxel() * static_cast<double>(cube_)),
      voxel_diagonal_(metric.voxel().norm()),
      label_limits_(std::move(label_limits)),
      gradation_(gradation),
      by_voxel_(by_voxel),
      values_(static_cast<std::size_t>(cubes_.product()), kUnlimited) {}

void SizeField::add(const Box3& box, std::span<const Label> voxels) {
  std::size_t i = 0;
  for_each_index(box, [&](Index3 v) {
    const double limit = of_label(voxels[i++]);
    if (limit == kNoLimit) return;
    float& value = values_[row(v.x / cube_, v.y / cube_, v.z / cube_)];
    value = std::min(value, rounded_down(limit));
  });
}

void SizeField::limit_voxel(Index3 voxel, double limit) {
  float& value = values_[row(voxel.x / cube_, voxel.y / cube_, voxel.z / cube_)];
  value = std::min(value, rounded_down(limit));
}

void SizeField::repeat_cell(Index3 cell, Index3 margin) {
  const std::vector<float> own = values_;
  const auto in_cell = [](std::int64_t v, std::int64_t size, std::int64_t around) {
    return around > 0 ? (v - around + 2 * size * around) % size + around : v;
  };
  const Box3 inner{margin, margin + cell};
  for_each_index(cubes_, [&](Index3 c) {
    const Index3 lo{c.x * cube_, c.y * cube_, c.z * cube_};
    const Box3 voxels{lo, lo + Index3{cube_, cube_, cube_}};
    if (intersection(voxels, inner) == voxels) return;
    float& value = values_[row(c.x, c.y, c.z)];
    for_each_index(voxels, [&](Index3 v) {
      const Index3 w{in_cell(v.x, cell.x, margin.x), in_cell(v.y, cell.y, margin.y),
                     in_cell(v.z, cell.z, margin.z)};
      if (inner.contains(w))
        value = std::min(value, own[row(w.x / cube_, w.y / cube_, w.z / cube_)]);
    });
  });
}

SizeField SizeField::around_cell(Index3 cell, Index3 margin) const {
  SizeField out = *this;
  out.is_around_cell_ = true;
  out.cell_ = cell;
  out.margin_ = margin;
  return out;
}

Point SizeField::in_volume(Point p) const {
  const auto along = [](std::int32_t units, std::int64_t voxels, std::int64_t around) {
    if (around == 0) return units;
    const std::int64_t size = voxels * kUnitsPerVoxel, rest = units % size;
    return static_cast<std::int32_t>((rest < 0 ? rest + size : rest) + around * kUnitsPerVoxel);
  };
  return {along(p.x, cell_.x, margin_.x), along(p.y, cell_.y, margin_.y),
          along(p.z, cell_.z, margin_.z)};
}

double SizeField::rung_below(double limit) {
  return rung_of(kWidestStep, limit);
}

void SizeField::spread() {
  std::vector<float> own = values_;
  std::vector<float> limits = distinct(own);
  if (limits.size() > kMostLimits) {
    while (limits.back() == kUnlimited) limits.pop_back();
    const double step =
        step_for(static_cast<double>(limits.front()), static_cast<double>(limits.back()));
    for (float& value : own) {
      if (value != kUnlimited) value = rounded_down(rung_of(step, static_cast<double>(value)));
    }
    limits = distinct(own);
  }
  std::vector<float> squared(own.size());
  for (const float limit : limits) {
    if (limit == kUnlimited) break;
    std::transform(own.begin(), own.end(), squared.begin(),
                   [&](float value) { return value == limit ? 0.0F : kUnlimited; });
    spread_squared_gaps(cubes_, cube_edges_, squared);
    for (std::size_t i = 0; i < own.size(); ++i) {
      const double grown = limit + gradation_ * std::sqrt(static_cast<double>(squared[i]));
      values_[i] = std::min(values_[i], rounded_down(grown));
    }
  }
  least_ = static_cast<double>(*std::min_element(values_.begin(), values_.end()));
  for (const double limit : label_limits_) least_ = std::min(least_, limit);
}

bool SizeField::allows_cell(Index3 lo, int level, Label label) const {
  if (level == 0 || !limits()) return true;
  const std::int64_t size = std::int64_t{1} << level;
  const double diagonal = static_cast<double>(size) * voxel_diagonal_;
  if (diagonal > of_label(label)) return false;
  const auto first = [&](std::int64_t v) { return v / cube_; };
  const auto end = [&](std::int64_t v, std::int64_t cubes) {
    return std::min((v + size) / cube_ + 1, cubes);
  };
  float min = kUnlimited;
  for_each_index(Box3{{first(lo.x), first(lo.y), first(lo.z)},
                      {end(lo.x, cubes_.x), end(lo.y, cubes_.y), end(lo.z, cubes_.z)}},
                 [&](Index3 c) { min = std::min(min, values_[row(c.x, c.y, c.z)]); });
  return diagonal <= static_cast<double>(min);
}

}  // namespace mw
