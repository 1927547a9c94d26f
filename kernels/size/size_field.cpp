// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cubes with listed labels, and a distance transform for each limit.
#include "kernels/size/size_field.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/for_each_index.h"
#include "kernels/size/cube_distance.h"

namespace mw {
namespace {

constexpr float kUnlimited = std::numeric_limits<float>::infinity();

float rounded_down(double value) {
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) > value ? std::nextafter(near, 0.0F) : near;
}

Index3 cubes_of(Index3 volume) {
  const auto along = [](std::int64_t n) { return (n + SizeField::kCube - 1) / SizeField::kCube; };
  return {along(volume.x), along(volume.y), along(volume.z)};
}

}  // namespace

SizeField::SizeField(Index3 volume, const Metric& metric, std::vector<double> label_limits,
                     double gradation)
    : cubes_(cubes_of(volume)),
      cube_edges_(metric.voxel() * kCube),
      voxel_diagonal_(metric.voxel().norm()),
      label_limits_(std::move(label_limits)),
      gradation_(gradation),
      values_(static_cast<std::size_t>(cubes_.product()), kUnlimited) {}

void SizeField::add(const Box3& box, std::span<const Label> voxels) {
  std::size_t i = 0;
  for_each_index(box, [&](Index3 v) {
    const double limit = of_label(voxels[i++]);
    if (limit == kNoLimit) return;
    float& value = values_[row(v.x / kCube, v.y / kCube, v.z / kCube)];
    value = std::min(value, rounded_down(limit));
  });
}

void SizeField::spread() {
  const std::vector<float> own = values_;
  std::vector<float> limits = own;
  std::sort(limits.begin(), limits.end());
  limits.erase(std::unique(limits.begin(), limits.end()), limits.end());
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
}

bool SizeField::allows_cell(Index3 lo, int level) const {
  if (level == 0 || !limits()) return true;
  const std::int64_t size = std::int64_t{1} << level;
  const auto first = [](std::int64_t v) { return v / kCube; };
  const auto end = [&](std::int64_t v, std::int64_t cubes) {
    return std::min((v + size) / kCube + 1, cubes);
  };
  float min = kUnlimited;
  for_each_index(Box3{{first(lo.x), first(lo.y), first(lo.z)},
                      {end(lo.x, cubes_.x), end(lo.y, cubes_.y), end(lo.z, cubes_.z)}},
                 [&](Index3 c) { min = std::min(min, values_[row(c.x, c.y, c.z)]); });
  return static_cast<double>(size) * voxel_diagonal_ <= static_cast<double>(min);
}

}  // namespace mw
