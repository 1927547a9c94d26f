// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "kernels/core/elementary.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "kernels/core/assert.h"

namespace mw {
namespace {

/// The logarithm of 2 in two parts, the first of which has so few digits that whole multiples of
/// it are exact.
constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;

/// Returns s + s^3 / 3 + s^5 / 5 ..., with signs in turn for sign = -1, for |s| < 0.2.
double odd_series(double s, double sign) {
  const double square = sign * s * s;
  double sum = 0;
  for (int n = 25; n >= 3; n -= 2) sum = square * (sum + 1.0 / n);
  return s + s * sum;
}

}  // namespace

double logarithm(double x) {
  MW_ASSERT(x > 0 && std::isfinite(x));
  int exponent = 0;
  double part = std::frexp(x, &exponent);
  if (part < std::numbers::sqrt2 / 2) {
    part *= 2;
    --exponent;
  }
  const double small = 2 * odd_series((part - 1) / (part + 1), 1);
  return exponent * kLn2High + (small + exponent * kLn2Low);
}

double exponential(double x) {
  MW_ASSERT(!std::isnan(x));
  constexpr double kOutOfRange = 800;
  x = std::clamp(x, -kOutOfRange, kOutOfRange);
  const double exponent = std::floor(x / std::numbers::ln2 + 0.5);
  const double rest = (x - exponent * kLn2High) - exponent * kLn2Low;
  double sum = 1;
  for (int n = 14; n >= 1; --n) sum = 1 + sum * rest / n;
  return std::ldexp(sum, static_cast<int>(exponent));
}

double power(double x, double y) {
  return exponential(y * logarithm(x));
}

double cube_root(double x) {
  MW_ASSERT(x > 0 && std::isfinite(x));
  int exponent = 0;
  double part = std::frexp(x, &exponent);
  const int shift = exponent - 3 * static_cast<int>(std::floor(exponent / 3.0));
  part = std::ldexp(part, shift);
  double root = 1;
  for (int i = 0; i < 8; ++i) root -= (root - part / (root * root)) / 3;
  return std::ldexp(root, (exponent - shift) / 3);
}

double angle_of(double sine, double cosine) {
  MW_ASSERT(sine > 0 && std::isfinite(sine) && std::isfinite(cosine));
  const double wide = std::abs(cosine);
  double ratio = std::min(sine, wide) / std::max(sine, wide);
  for (int i = 0; i < 2; ++i) ratio /= 1 + std::sqrt(1 + ratio * ratio);
  double angle = 4 * odd_series(ratio, -1);
  if (sine > wide) angle = std::numbers::pi / 2 - angle;
  return cosine < 0 ? std::numbers::pi - angle : angle;
}

double power_of_ten_below(double x) {
  MW_ASSERT(x >= 0 && std::isfinite(x));
  if (x == 0) return 0;
  std::array<char, 32> text{};
  char* const end =
      std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific).ptr;
  char* const exponent = std::find(text.data(), end, 'e') - 1;
  *exponent = '1';
  double out = 0;
  std::from_chars(exponent, end, out);
  return out;
}

}  // namespace mw
