// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Vectors of three doubles for code that must not need Eigen, as files and audits hold them.
#pragma once

#include <array>
#include <cmath>

namespace mw {

using Vector3 = std::array<double, 3>;

[[nodiscard]] inline Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

[[nodiscard]] inline double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[nodiscard]] inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

[[nodiscard]] inline double norm(const Vector3& a) {
  return std::sqrt(dot(a, a));
}

/// Returns the determinant of three rows, doubles or whole numbers.
template <typename Number>
[[nodiscard]] Number determinant(const std::array<Number, 3>& a, const std::array<Number, 3>& b,
                                 const std::array<Number, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Returns six times the signed volume, positive when d is where the normal of a b c points.
[[nodiscard]] inline double volume6(const Vector3& a, const Vector3& b, const Vector3& c,
                                    const Vector3& d) {
  return determinant(minus(b, a), minus(c, a), minus(d, a));
}

}  // namespace mw
