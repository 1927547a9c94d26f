// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Angles by a series, a projection, a palette, and cuts.
#include "kernels/picture/view.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mw::picture {
namespace {

/// Sine of an angle from 0 to 90 degrees; right to the last digits.
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

/// Muted colours of similar weight; neighbours in the list differ.
constexpr std::array<Colour, 16> kPalette{{{186, 176, 172},
                                           {78, 121, 167},
                                           {242, 142, 43},
                                           {89, 161, 79},
                                           {225, 87, 89},
                                           {118, 183, 178},
                                           {237, 201, 72},
                                           {176, 122, 161},
                                           {156, 117, 95},
                                           {160, 203, 232},
                                           {255, 157, 167},
                                           {140, 209, 125},
                                           {73, 136, 148},
                                           {211, 114, 149},
                                           {182, 153, 45},
                                           {212, 166, 200}}};

std::uint8_t clamped(double value) {
  return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0));
}

/// Where the edge from a point that stays to one that goes meets the plane.  The ends always come
/// in this order, so that all tets and triangles that share the edge get the same point.
Vec3 crossing(const Vec3& stays, const Vec3& goes, const CutPlane& plane) {
  const double a = plane.height(stays), b = plane.height(goes);
  return stays + (goes - stays) * (a / (a - b));
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

Colour mixed(const Colour& one, const Colour& other, double share) {
  Colour out{};
  for (std::size_t k = 0; k < 3; ++k) out[k] = clamped(one[k] + (other[k] - one[k]) * share);
  return out;
}

Colour palette_colour(RawLabel label) {
  const Colour& base = kPalette[label % kPalette.size()];
  // Later rounds of the palette are lighter or darker.
  constexpr std::array<double, 5> kShades{0, 0.3, -0.25, 0.45, -0.4};
  const double shade = kShades[label / kPalette.size() % kShades.size()];
  return shade < 0 ? mixed(base, {0, 0, 0}, -shade) : mixed(base, {255, 255, 255}, shade);
}

Vec3 normal_of(const std::array<Vec3, 3>& triangle) {
  return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
}

Colour lit(const Colour& colour, const Vec3& normal, const View& view) {
  const Vec3 light = view.viewer + 0.5 * view.up - 0.35 * view.right;
  const double lengths = std::sqrt(normal.squaredNorm() * light.squaredNorm());
  if (lengths == 0) return colour;
  constexpr double kAmbient = 0.52, kBrightest = 1.03;
  const double facing = std::max(normal.dot(light) / lengths, 0.0);
  return mixed({0, 0, 0}, colour, kAmbient + (kBrightest - kAmbient) * facing);
}

Piece clipped(const std::array<Vec3, 3>& triangle, const CutPlane& plane) {
  Piece out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& p = triangle[i];
    const Vec3& q = triangle[(i + 1) % 3];
    const bool p_stays = plane.height(p) <= 0, q_stays = plane.height(q) <= 0;
    if (p_stays) out.add(p);
    if (p_stays != q_stays) out.add(p_stays ? crossing(p, q, plane) : crossing(q, p, plane));
  }
  return out;
}

Piece cross_section(const std::array<Vec3, 4>& tet, const CutPlane& plane) {
  std::array<const Vec3*, 4> stay{}, go{};
  std::size_t stays = 0, goes = 0;
  for (const Vec3& corner : tet) {
    (plane.height(corner) <= 0 ? stay[stays++] : go[goes++]) = &corner;
  }
  Piece out;
  if (stays == 2) {
    // The corners go around the tet, so that neighbours share a face.
    for (const auto& [s, g] : {std::pair(0, 0), std::pair(0, 1), std::pair(1, 1), std::pair(1, 0)})
      out.add(
          crossing(*stay[static_cast<std::size_t>(s)], *go[static_cast<std::size_t>(g)], plane));
    return out;
  }
  for (std::size_t s = 0; s < stays && goes > 0; ++s) {
    for (std::size_t g = 0; g < goes; ++g) out.add(crossing(*stay[s], *go[g], plane));
  }
  return out;
}

}  // namespace mw::picture
