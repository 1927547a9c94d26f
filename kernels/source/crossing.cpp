// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The zero of a falling cubic, by halving, and the place near a point where a function is zero.
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

/// Weights of four values in the value and in the slope between the second and the third.
struct CubicWeights {
  std::array<double, 4> value;
  std::array<double, 4> slope;
};

CubicWeights weights_at(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {{0.5 * (-t3 + 2 * t2 - t), 0.5 * (3 * t3 - 5 * t2 + 2), 0.5 * (-3 * t3 + 4 * t2 + t),
           0.5 * (t3 - t2)},
          {0.5 * (-3 * t2 + 4 * t - 1), 0.5 * (9 * t2 - 10 * t), 0.5 * (-9 * t2 + 8 * t + 1),
           0.5 * (3 * t2 - 2 * t)}};
}

/// Interpolates where a point is, in voxels from the first corner.
ValueAndSlope look_at(const CubicField& field, const Vec3& point) {
  std::array<std::int64_t, 3> below{};
  Vec3 at;
  for (int k = 0; k < 3; ++k) {
    const double from_centre = point[k] - 0.5, floor = std::floor(from_centre);
    below[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(floor);
    at[k] = from_centre - floor;
  }
  return interpolate(field.values_from({below[0] - 1, below[1] - 1, below[2] - 1}), at);
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

ValueAndSlope interpolate(const CubicValues& values, const Vec3& at) {
  const CubicWeights x = weights_at(at[0]), y = weights_at(at[1]), z = weights_at(at[2]);
  ValueAndSlope out;
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t j = 0; j < 4; ++j) {
      double value = 0.0, slope = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        const double v = values[16 * k + 4 * j + i];
        value += x.value[i] * v;
        slope += x.slope[i] * v;
      }
      out.value += z.value[k] * y.value[j] * value;
      out.slope += Vec3(z.value[k] * y.value[j] * slope, z.value[k] * y.slope[j] * value,
                        z.slope[k] * y.value[j] * value);
    }
  }
  return out;
}

std::optional<Vec3> find_zero(const CubicField& field, const Vec3& near, const Vec3& voxel,
                              double reach) {
  constexpr int kSteps = 12;
  constexpr double kArrived = 1e-7;  // voxels
  Vec3 point = near;
  for (int i = 0; i < kSteps; ++i) {
    const auto [value, slope] = look_at(field, point);
    const Vec3 across = slope.cwiseQuotient(voxel).cwiseQuotient(voxel);
    const double square = slope.dot(across);
    if (!(square > 0.0) || !std::isfinite(value)) return std::nullopt;
    const Vec3 step = across * (-value / square);
    point += step;
    if (!((point - near).norm() <= reach)) return std::nullopt;
    if (step.norm() <= kArrived) return point;
  }
  return std::nullopt;
}

}  // namespace mw
