// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A palette and a light.
#include "kernels/picture/shade.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mw::picture {
namespace {

/// Muted, of like weight, neighbours unlike.
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

}  // namespace

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

}  // namespace mw::picture
