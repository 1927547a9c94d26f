// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The place near a point where a function that is known at the centres of voxels is zero.
#include "kernels/source/cubic_zero.h"

#include <cmath>

namespace mw {
namespace {

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
