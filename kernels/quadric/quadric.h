// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Quadric error functions of Sec 5.2, kept relative to the position of their vertex.
#pragma once

#include <array>

#include "kernels/core/metric.h"

namespace mw {

/// The error x -> x^T A x + 2 b^T x + c, where x is the offset from the owner's position (metric
/// units).  The paper uses homogeneous coordinates of the whole volume; relative ones lose no
/// digits on large volumes and make the result independent of where a window lies.
struct Quadric {
  /// Upper triangle of A: xx, xy, xz, yy, yz, zz.
  std::array<double, 6> a{};
  std::array<double, 3> b{};
  double c = 0.0;

  friend bool operator==(const Quadric&, const Quadric&) = default;

  /// Eq (1): squared distance to a plane through the owner with the given unit normal axis.
  void add_axis_plane(int axis, double weight);
  /// Eq (1) for any plane, through a point at an offset from the owner.
  void add_plane(const Vec3& unit_normal, const Vec3& through, double weight);
  /// Eq (2): squared distance to the owner's position.
  void add_point(double weight);

  /// A
  [[nodiscard]] Eigen::Matrix3d matrix() const {
    Eigen::Matrix3d m;
    m << a[0], a[1], a[2], a[1], a[3], a[4], a[2], a[4], a[5];
    return m;
  }
  [[nodiscard]] Vec3 linear() const { return {b[0], b[1], b[2]}; }
  [[nodiscard]] double trace() const { return a[0] + a[3] + a[5]; }
  [[nodiscard]] double value(const Vec3& x) const {
    return x.dot(matrix() * x) + 2.0 * linear().dot(x) + c;
  }
  /// This function, relative to a position at `offset` from the present one.
  [[nodiscard]] Quadric shifted(const Vec3& offset) const;
};

[[nodiscard]] Quadric operator+(const Quadric& p, const Quadric& q);

/// Where the error is least, and how large it is there.
struct QuadricMinimum {
  Vec3 offset;
  double value = 0.0;
};

/// Minimum over the axes whose bit is not set in fixed_axes (bit 0 = x); the others stay at 0.
/// REQUIRES: A positive definite, which every quadric with a point term is.
[[nodiscard]] QuadricMinimum minimum(const Quadric& q, unsigned fixed_axes);

}  // namespace mw
