// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Colours from CIELab to XYZ (CIE 15), and from there to sRGB (IEC 61966-2-1).
#include "io/names/label_names.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/elementary.h"

namespace mw::io {
namespace {

constexpr std::array<double, 3> kWhite{0.96422, 1, 0.82521};  ///< XYZ of D50

/// Turns XYZ under D50 into linear red, green and blue under D65, one a row.
constexpr std::array<std::array<double, 3>, 3> kLinearOfXyz{{{3.1338561, -1.6168667, -0.4906146},
                                                             {-0.9787684, 1.9161415, 0.0334540},
                                                             {0.0719453, -0.2289914, 1.4052427}}};

/// Returns the share of white for its cube root; dark colours are on a line that touches the cube.
double share_of_root(double root) {
  constexpr double kEnd = 6.0 / 29;
  return root > kEnd ? root * root * root : 3 * kEnd * kEnd * (root - 4.0 / 29);
}

std::uint8_t byte_of_linear(double linear) {
  const double light = std::clamp(linear, 0.0, 1.0);
  const double shown = light <= 0.0031308 ? 12.92 * light : 1.055 * power(light, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * shown));
}

}  // namespace

CieLab cielab_of(const std::array<std::uint16_t, 3>& spread) {
  const auto share = [&](std::size_t i) { return spread[i] / 65535.0; };
  return {.lightness = 100 * share(0), .a = 255 * share(1) - 128, .b = 255 * share(2) - 128};
}

Colour srgb_of(const CieLab& lab) {
  const double root = (lab.lightness + 16) / 116;
  const std::array<double, 3> xyz{kWhite[0] * share_of_root(root + lab.a / 500),
                                  kWhite[1] * share_of_root(root),
                                  kWhite[2] * share_of_root(root - lab.b / 200)};
  Colour out{0, 0, 0, 255};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = kLinearOfXyz[i];
    out[i] = byte_of_linear(row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2]);
  }
  return out;
}

}  // namespace mw::io
