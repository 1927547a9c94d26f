// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From where a picture is taken, where points come to lie in it, and how light falls on labels.
#pragma once

#include <limits>

#include "kernels/core/label.h"
#include "kernels/core/metric.h"
#include "kernels/picture/raster.h"

namespace mw::picture {

/// Three unit vectors at right angles: to the right and up in the picture, and to the viewer.
struct View {
  Vec3 right;
  Vec3 up;
  Vec3 viewer;
};

/// The viewer stands at that angle from +x towards +y, and so far above the plane of both; z is up.
/// With elevation 90 and azimuth -90 x is to the right and y up.  Degrees.
/// Angles become sines by a series, not by the C library, whose last digits differ.
/// REQUIRES: finite.
[[nodiscard]] View view_from(double azimuth, double elevation);

/// What a picture has to show, in the axes of its view.
struct Extent {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 hi = -lo;

  void add(const View& view, const Vec3& point);
  [[nodiscard]] bool empty() const { return !(lo[0] <= hi[0]); }
};

/// Parallel projection of an extent into the middle of a picture.
class Camera {
 public:
  /// REQUIRES: an extent that is not empty, and finite; width and height from 1 to
  /// Raster::kMaxPixels.  Leaves a margin of 4 % of the shorter side.
  Camera(const View& view, const Extent& extent, int width, int height);

  /// REQUIRES: a point in the extent.
  [[nodiscard]] ScreenPoint at(const Vec3& point) const;

 private:
  View view_;
  Vec3 middle_;
  double scale_;  ///< pixels a unit of length
  double depth_;  ///< of the extent
  double x_, y_;  ///< of the picture's middle
};

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
