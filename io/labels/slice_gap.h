// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How far up a label reaches between two slices of which only one has it.
#pragma once

#include <array>

#include "io/labels/slice_distances.h"

namespace mw::io {

/// One pixel on the way from a slice, which has one label there, to the next, which has another.
/// Both labels are seen in four slices: the two, the one before and the one behind them.
struct SliceGap {
  using Column = std::array<LabelDepth, 4>;

  double thickness = 1;  ///< distance of slices, in the units of depths
  Column lower;          ///< the label of the first slice, from before it to behind the second
  Column upper;          ///< the label of the second, in the same slices
};

/// Returns by how much the first slice's label is deeper than the second's at (part / parts) of the
/// way; 0 or less where it is not.
///
/// *Contours that move.*  The heights of a label in both slices are joined by the parabola whose
/// curvature is the mean of those over three slices each.  Divided by twice the radius they are
/// distances from its contour; the thinner of the two labels counts more.
///
/// *Labels that end.*  A cap goes on from the last two slices with the curvature of a round end. It
/// is at most 7/8 of the way high, so that a flat end keeps about half a slice.  The cap of a label
/// counts where it reaches beyond the contour, and as much as the label is far off in the other
/// slice.
///
/// ENSURES: the sign turns exactly when the slices change places.
[[nodiscard]] double lower_margin(const SliceGap& gap, std::int64_t part, std::int64_t parts);

}  // namespace mw::io
