// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Exact orientation: a floating point filter, then Boost.Multiprecision integers.
#include "kernels/audit/partition/orientation.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

namespace mw::audit {
namespace {

using boost::multiprecision::cpp_int;

/// Differences outside of this range could under- or overflow in a product of three, where the
/// filter's relative bound does not hold.
constexpr double kSmallest = 1e-100;
constexpr double kLargest = 1e100;
constexpr int kMantissaBits = 53;

using Rows = std::array<Position, 3>;

/// True if the magnitudes of all differences are 0 or in that range.
bool in_range(const Rows& rows) {
  for (const Position& row : rows) {
    for (const double value : row) {
      const double size = std::abs(value);
      if (size > kLargest || (size < kSmallest && size != 0)) return false;
    }
  }
  return true;
}

/// The exponent of the last bit of the smallest non-zero coordinate.
int common_exponent(std::span<const Position* const> points) {
  int min = std::numeric_limits<int>::max();
  for (const Position* point : points) {
    for (const double value : *point) {
      int exponent = 0;
      if (std::frexp(value, &exponent) != 0) min = std::min(min, exponent - kMantissaBits);
    }
  }
  return min;
}

/// value / 2^unit as a whole number.  REQUIRES: unit is common_exponent of a set with value.
cpp_int scaled(double value, int unit) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  if (mantissa == 0) return 0;
  const auto digits = static_cast<std::int64_t>(std::ldexp(mantissa, kMantissaBits));
  return cpp_int(digits) * (cpp_int(1) << static_cast<unsigned>(exponent - kMantissaBits - unit));
}

int sign_of(std::span<const Position> at, const TetRow& t) {
  return orientation(at[t[0]], at[t[1]], at[t[2]], at[t[3]]);
}

bool is_finite(const Position& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

}  // namespace

std::optional<int> filtered_orientation(const Position& a, const Position& b, const Position& c,
                                        const Position& d) {
  Rows rows{};
  for (std::size_t k = 0; k < 3; ++k) {
    rows[0][k] = b[k] - a[k];
    rows[1][k] = c[k] - a[k];
    rows[2][k] = d[k] - a[k];
  }
  if (!in_range(rows)) return std::nullopt;
  double sum = 0;
  double permanent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Position& p = rows[(i + 1) % 3];
    const Position& q = rows[(i + 2) % 3];
    const double left = p[1] * q[2];
    const double right = p[2] * q[1];
    sum += rows[i][0] * (left - right);
    permanent += std::abs(rows[i][0]) * (std::abs(left) + std::abs(right));
  }
  // Every term of the sum has at most 8 roundings behind it (3 differences, 2 products, a
  // subtraction, 2 additions); 16 leaves room for the terms of second order and for permanent's
  // own.
  const double bound = 16 * 0x1p-53 * permanent;
  if (sum > bound) return 1;
  if (-sum > bound) return -1;
  return std::nullopt;
}

int exact_orientation(const Position& a, const Position& b, const Position& c, const Position& d) {
  const std::array<const Position*, 4> points{&a, &b, &c, &d};
  const int unit = common_exponent(points);
  std::array<std::array<cpp_int, 3>, 3> rows;
  for (std::size_t k = 0; k < 3; ++k) {
    const cpp_int base = scaled(a[k], unit);
    for (std::size_t i = 0; i < 3; ++i) rows[i][k] = scaled((*points[i + 1])[k], unit) - base;
  }
  cpp_int det = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& p = rows[(i + 1) % 3];
    const auto& q = rows[(i + 2) % 3];
    det += rows[i][0] * (p[1] * q[2] - p[2] * q[1]);
  }
  return det.sign();
}

int orientation(const Position& a, const Position& b, const Position& c, const Position& d) {
  if (const auto sign = filtered_orientation(a, b, c, d)) return *sign;
  return exact_orientation(a, b, c, d);
}

Offenders changed_orientations(const MeshTile& turned, std::span<const Position> written,
                               bool mirrored) {
  Offenders wrong("tets");
  if (!std::all_of(written.begin(), written.end(), is_finite)) return wrong;
  // Tets of the turned mesh were mirrored with it: both see the same tet from the same side.
  for (std::size_t t = 0; t < turned.mesh.tets.size(); ++t) {
    if (!turned.owns_tet(t)) continue;
    TetRow tet = turned.mesh.tets[t];
    const int in_array = sign_of(turned.mesh.vertices, tet);
    if (mirrored) std::swap(tet[2], tet[3]);
    if (sign_of(written, tet) == in_array) continue;
    wrong.add([&] { return std::to_string(turned.tet_id(t)); });
  }
  return wrong;
}

Check kept_orientation(const Offenders& changed) {
  return {"P2 orientation in the world", changed.count() == 0,
          changed.text() + " change their sign by the rounding of coordinates"};
}

}  // namespace mw::audit
