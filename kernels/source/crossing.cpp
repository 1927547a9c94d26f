// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The zero of a falling cubic, by halving.
#include "kernels/source/crossing.h"

#include <algorithm>
#include <cmath>

namespace mw {
namespace {

/// A cubic by its values and slopes at 0 and 1.
struct Cubic {
  std::array<double, 2> values;
  std::array<double, 2> slopes;

  [[nodiscard]] double at(double t) const {
    const double s = 1.0 - t;
    return s * s * ((1.0 + 2.0 * t) * values[0] + t * slopes[0]) +
           t * t * ((1.0 + 2.0 * s) * values[1] - s * slopes[1]);
  }
};

/// REQUIRES: the cubic is not negative at 0 and not positive at 1.
double zero_of(const Cubic& cubic) {
  constexpr int kHalvings = 32;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (cubic.at(middle) >= 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

bool is_finite(const ScoreDifference& d) {
  return std::isfinite(d.values[0]) && std::isfinite(d.values[1]) && d.slopes[0].allFinite() &&
         d.slopes[1].allFinite();
}

/// Normalises a direction; returns the axis itself unless it points to the upper side.
Vec3 upwards(const Vec3& direction, unsigned axis) {
  const double length = direction.norm();
  const bool points_up = direction[static_cast<int>(axis)] > 0.0;
  constexpr double kTiny = 1e-150;  // the squares of shorter directions are no normal numbers
  if (!points_up || !std::isfinite(length) || length < kTiny)
    return Vec3::Unit(static_cast<int>(axis));
  return direction / length;
}

}  // namespace

SourcePlane find_crossing(const ScoreDifference& difference, unsigned axis) {
  const auto [low, high] = difference.values;
  const auto k = static_cast<int>(axis);
  const double way = high - low;
  if (!is_finite(difference) || !(low >= 0.0 && high <= 0.0 && way < 0.0)) {
    return {Vec3::Unit(k), 0.0};
  }
  const auto limited = [way](double slope) { return std::clamp(slope, 3.0 * way, 0.0); };
  const double t =
      zero_of({{low, high}, {limited(difference.slopes[0][k]), limited(difference.slopes[1][k])}});
  const Vec3 slope = (1.0 - t) * difference.slopes[0] + t * difference.slopes[1];
  return {upwards(-slope, axis), t - 0.5};
}

PlaneForm crossing_form(Index3 layers) {
  const auto most = static_cast<double>(std::max({layers.x, layers.y, layers.z}));
  return {.along_axis = true, .reach = 0.5 * most, .height_bits = 12, .normal_bits = 10};
}

SourcePlane on_lattice(const SourcePlane& crossing, const LayeredFace& face) {
  const auto k = static_cast<int>(face.axis);
  const Vec3 layers(static_cast<double>(face.layers.x), static_cast<double>(face.layers.y),
                    static_cast<double>(face.layers.z));
  const Vec3 normal = upwards(crossing.normal.cwiseQuotient(layers), face.axis);
  Vec3 to_crossing = -face.centre;
  to_crossing[k] += crossing.height * layers[k];
  const double height = normal.dot(to_crossing) / normal[k];
  const double reach = crossing_form(face.layers).reach;
  return {normal, std::clamp(height, -reach, reach)};
}

}  // namespace mw
