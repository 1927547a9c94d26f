// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parabolas along the axis of slices.
#include "io/labels/slice_gap.h"

#include <algorithm>

namespace mw::io {
namespace {

/// How much of the way to the next slice a cap may be high.
constexpr double kHighestCap = 7.0 / 8;
/// Least curvature of caps, in that of balls.  Less than 1, as many are longer than they are wide.
constexpr double kLeastCap = 7.0 / 8;
/// How much of the way the cap of a thin label is high, so that it has the volume of half a slice:
/// 3/4 where it is round, 1/2 where it is one pixel wide, with the radius 1/2.
constexpr double kThinCap = 3.0 / 4;
constexpr double kOnePixelCap = 1.0 / 8;
/// Most curvature of contours that move.
constexpr double kMostBend = 1.5;
/// A label with this many times less radius than the other is the one that ends.
constexpr double kMuchThinner = 1.5;

/// A label on its way from the slice that has it to the one that does not.
struct Way {
  LabelDepth before;  ///< one slice further back
  LabelDepth here;
  LabelDepth there;
  LabelDepth behind;
};

/// Returns the depth that the label has after t of the way if its contour moves.
double contour_depth(const Way& way, double thickness, double t) {
  const double back = way.before.height - 2 * way.here.height + way.there.height;
  const double ahead = way.here.height - 2 * way.there.height + way.behind.height;
  const double square = thickness * thickness;
  const double bend = std::clamp(-(back + ahead) / (4 * square), 0.0, kMostBend);
  const double height =
      (1 - t) * way.here.height + t * way.there.height + square * bend * (t * (1 - t));
  return height / (2 * way.here.radius);
}

/// Returns the depth that the label has after t of the way if it ends before the next slice.
double cap_depth(const Way& way, double thickness, double t) {
  const double top = kHighestCap * thickness;
  const double radius2 = way.here.radius * way.here.radius;
  const double slope = (way.before.height - way.here.height) / thickness;
  // The cap must be closed at the top, with this slope or, if it turned the cap inwards, with none.
  const double flat = radius2 / (top * top);
  const double closed =
      slope + flat * thickness > 0 ? (radius2 - top * slope) / (top * thickness + top * top) : flat;
  // Where a label is thin a round cap would be flat: it keeps half the slice, too.
  const double half = (kThinCap - kOnePixelCap / way.here.radius) * thickness;
  const double bend = std::max(std::min(kLeastCap, radius2 / (half * half)), closed);
  const double fall = std::max(0.0, slope + bend * thickness);
  const double up = t * thickness;
  return (way.here.height - fall * up - bend * up * up) / (2 * way.here.radius);
}

/// Returns how much the cap of a label counts, which is `own` thick and this far off in the other
/// slice.
double cap_share(double own, double far_off, double other, double other_far_off) {
  const double ratio = std::max(far_off, 0.5) / std::max(other_far_off, 0.5);
  return std::clamp(own * kMuchThinner < other ? 4 * ratio : ratio - 1, 0.0, 1.0);
}

}  // namespace

double lower_margin(const SliceGap& gap, std::int64_t part, std::int64_t parts) {
  const Way a{gap.lower[0], gap.lower[1], gap.lower[2], gap.lower[3]};
  const Way b{gap.upper[3], gap.upper[2], gap.upper[1], gap.upper[0]};
  const double all = static_cast<double>(parts);
  const double up = static_cast<double>(part) / all, down = static_cast<double>(parts - part) / all;
  const double ra = a.here.radius, rb = b.here.radius;
  const double contour =
      (contour_depth(a, gap.thickness, up) * rb - contour_depth(b, gap.thickness, down) * ra) /
      (ra + rb);
  const double far_a = -a.there.depth, far_b = -b.there.depth;
  const double gain_a =
      cap_share(ra, far_a, rb, far_b) * std::max(0.0, cap_depth(a, gap.thickness, up) - contour);
  const double gain_b =
      cap_share(rb, far_b, ra, far_a) * std::max(0.0, cap_depth(b, gap.thickness, down) + contour);
  return contour + (gain_a - gain_b);
}

}  // namespace mw::io
