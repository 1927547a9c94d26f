// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The energy of a bend between two triangles of an interface.
#pragma once

#include <algorithm>

#include "kernels/core/metric.h"

namespace mw {

/// Bends whose 1 - cosine is below this, some 14 degrees, cost nothing, because curved surfaces
/// have them (bench/parameters.md, "Constants").
inline constexpr double kFreeBend = 0.03;
/// The cosine of a sharp bend, 60 degrees.
inline constexpr double kSharpCosine = 0.5;

/// How far a bend goes beyond what is free, by the cosine of the angle between the normals.
[[nodiscard]] inline double bend_excess(double cosine) {
  return std::max(0.0, 1.0 - cosine - kFreeBend);
}

/// Energy of a bend, which is the square of the excess.  It is 0 up to 14 degrees and about 4 at
/// 180, and it grows steeply where a surface turns back on itself.
[[nodiscard]] inline double bend_energy(double cosine) {
  const double excess = bend_excess(cosine);
  return excess * excess;
}

/// Energy of the bend between two normals of any length, from their dot product and the product of
/// their squared lengths; 0 when one is zero.  Most bends are free, which takes no root to see.
[[nodiscard]] inline double bend_energy(double product, double squares) {
  constexpr double kSurelyFree = 1.0 - 0.999 * kFreeBend;
  if (product > 0.0 && product * product >= kSurelyFree * kSurelyFree * squares) return 0.0;
  return squares > 0.0 ? bend_energy(product / std::sqrt(squares)) : 0.0;
}

/// Cosine between two normals of any length; 1 when one of them is zero.
[[nodiscard]] inline double cosine_between(const Vec3& m, const Vec3& n) {
  const double squares = m.squaredNorm() * n.squaredNorm();
  return squares > 0.0 ? m.dot(n) / std::sqrt(squares) : 1.0;
}

}  // namespace mw
