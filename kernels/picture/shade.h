// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Colours of labels, and how light falls on them.
#pragma once

#include "kernels/core/label.h"
#include "kernels/picture/raster.h"
#include "kernels/picture/view.h"

namespace mw::picture {

/// The colour of a label that has none of its own: a function of the label alone, the labels
/// 0 to 15 all different.
[[nodiscard]] Colour palette_colour(RawLabel label);

/// Twice the area long; its corners are counterclockwise seen from where it points.
[[nodiscard]] Vec3 normal_of(const std::array<Vec3, 3>& triangle);

/// The colour of a face with that normal of any length, lit from beside the viewer; without a
/// normal (zero) the colour itself.
[[nodiscard]] Colour lit(const Colour& colour, const Vec3& normal, const View& view);

/// share 0: one, 1: other.
[[nodiscard]] Colour mixed(const Colour& one, const Colour& other, double share);

}  // namespace mw::picture
