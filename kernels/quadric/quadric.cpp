// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Quadric algebra (Sec 5.2) with Eigen's fixed-size matrices.
#include "kernels/quadric/quadric.h"

#include <Eigen/Dense>

namespace mw {

void Quadric::add_axis_plane(int axis, double weight) {
  constexpr std::array<std::size_t, 3> kDiagonal{0, 3, 5};
  a[kDiagonal[static_cast<std::size_t>(axis)]] += weight;
}

void Quadric::add_plane(const Vec3& n, const Vec3& through, double weight) {
  const double d = -n.dot(through);
  a[0] += weight * n[0] * n[0];
  a[1] += weight * n[0] * n[1];
  a[2] += weight * n[0] * n[2];
  a[3] += weight * n[1] * n[1];
  a[4] += weight * n[1] * n[2];
  a[5] += weight * n[2] * n[2];
  for (std::size_t i = 0; i < 3; ++i) b[i] += weight * d * n[static_cast<int>(i)];
  c += weight * d * d;
}

void Quadric::add_point(double weight) {
  a[0] += weight;
  a[3] += weight;
  a[5] += weight;
}

Quadric Quadric::shifted(const Vec3& offset) const {
  const Vec3 slope = matrix() * offset;
  Quadric out = *this;
  for (std::size_t i = 0; i < 3; ++i) out.b[i] += slope[static_cast<Eigen::Index>(i)];
  out.c = value(offset);
  return out;
}

Quadric operator+(const Quadric& p, const Quadric& q) {
  Quadric out;
  for (std::size_t i = 0; i < 6; ++i) out.a[i] = p.a[i] + q.a[i];
  for (std::size_t i = 0; i < 3; ++i) out.b[i] = p.b[i] + q.b[i];
  out.c = p.c + q.c;
  return out;
}

QuadricMinimum minimum(const Quadric& q, unsigned fixed_axes) {
  Eigen::Matrix3d m = q.matrix();
  Vec3 b = q.linear();
  for (int i = 0; i < 3; ++i) {
    if ((fixed_axes >> i & 1U) == 0) continue;
    m.row(i).setZero();
    m.col(i).setZero();
    m(i, i) = 1.0;
    b[i] = 0.0;
  }
  const Vec3 x = m.inverse() * (-b);
  return {x, q.value(x)};
}

}  // namespace mw
