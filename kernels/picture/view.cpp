// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Angles by a series, and a projection.
#include "kernels/picture/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mw::picture {
namespace {

/// Of an angle from 0 to 90 degrees; right to the last digits.
double sine_of_quarter(double degrees) {
  const double x = degrees * (std::numbers::pi / 180);
  double term = x, sum = x;
  for (int n = 2; n <= 24; n += 2) {
    term *= -x * x / (n * (n + 1));
    sum += term;
  }
  return sum;
}

double sine(double degrees) {
  const double turned = std::fmod(degrees, 360.0);  // exact
  const double angle = turned < 0 ? turned + 360 : turned;
  if (angle > 180) return -sine(angle - 180);
  return sine_of_quarter(angle > 90 ? 180 - angle : angle);
}

double cosine(double degrees) {
  return sine(std::fmod(degrees, 360.0) + 90);
}

}  // namespace

View view_from(double azimuth, double elevation) {
  const double ca = cosine(azimuth), sa = sine(azimuth);
  const double ce = cosine(elevation), se = sine(elevation);
  return {.right = {-sa, ca, 0}, .up = {-se * ca, -se * sa, ce}, .viewer = {ce * ca, ce * sa, se}};
}

void Extent::add(const View& view, const Vec3& point) {
  const Vec3 seen{view.right.dot(point), view.up.dot(point), view.viewer.dot(point)};
  lo = lo.cwiseMin(seen);
  hi = hi.cwiseMax(seen);
}

Camera::Camera(const View& view, const Extent& extent, int width, int height)
    : view_(view),
      middle_((extent.lo + extent.hi) / 2),
      depth_(extent.hi[2] - extent.lo[2]),
      x_(width / 2.0),
      y_(height / 2.0) {
  constexpr double kMargin = 0.04;
  const double margin = 2 * kMargin * std::min(width, height);
  const Vec3 size = extent.hi - extent.lo;
  const double across = std::max(size[0] / (width - margin), size[1] / (height - margin));
  scale_ = across > 0 ? 1 / across : 0;
}

ScreenPoint Camera::at(const Vec3& point) const {
  const double x = view_.right.dot(point) - middle_[0];
  const double y = view_.up.dot(point) - middle_[1];
  const double nearer = view_.viewer.dot(point) - middle_[2];
  const double depth = depth_ > 0 ? 0.5 - nearer / depth_ : 0.5;
  return {x_ + x * scale_, y_ - y * scale_, std::clamp(depth, 0.0, 1.0)};
}

}  // namespace mw::picture
