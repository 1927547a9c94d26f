// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Elementary functions whose last digits are the same on every machine.
#pragma once

namespace mw {

// A C library computes logarithms and their kin by other instructions on other processors, and by
// other formulas in other versions, so that last digits differ.  A mesh must not depend on them
// (P5).  These functions add, multiply, divide and take square roots alone, which IEEE 754 defines
// to the last bit.  Their relative error is below 1e-15; that of power() grows with |y log x|.

/// Returns the natural logarithm.  REQUIRES: x is finite and positive.
[[nodiscard]] double logarithm(double x);

/// Returns e to the power of x: 0 or infinity where that is out of range.  REQUIRES: not NaN.
[[nodiscard]] double exponential(double x);

/// Returns x to the power of y.  REQUIRES: x is finite and positive, y is not NaN.
[[nodiscard]] double power(double x, double y);

/// Returns the cube root.  REQUIRES: x is finite and positive.
[[nodiscard]] double cube_root(double x);

/// Returns the angle from 0 to pi whose sine and cosine have the ratio of these two.
/// REQUIRES: both are finite, sine is positive.
[[nodiscard]] double angle_of(double sine, double cosine);

/// Returns the largest power of ten, with a whole exponent, that is not above x; 0 for 0.
/// REQUIRES: x is finite and not negative.
[[nodiscard]] double power_of_ten_below(double x);

}  // namespace mw
