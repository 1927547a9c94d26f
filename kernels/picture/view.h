// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From where a picture is taken, where points come to lie in it, how light falls on labels, and
// triangles and tets cut by a plane.
#pragma once

#include <limits>
#include <span>

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

/// The viewer stands `azimuth` degrees from +x towards +y and `elevation` degrees above the plane
/// of both; z is up.  With elevation 90 and azimuth -90, x is to the right and y up.
/// Angles become sines by a series, as the last digits of the C library differ between machines.
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
  /// Returns the length in pixels of what lies across the view; 0 for a single point.
  [[nodiscard]] double pixels_a_unit() const { return scale_; }

 private:
  View view_;
  Vec3 middle_;
  double scale_;  ///< pixels a unit of length
  double depth_;  ///< depth of the extent
  double x_, y_;  ///< middle of the picture
};

/// The colour of a label that has none of its own.  It follows from the label alone, and the labels
/// 0 to 15 are all different.
[[nodiscard]] Colour palette_colour(RawLabel label);

/// The triangle's normal, twice the area long; seen from its tip the corners are counterclockwise.
[[nodiscard]] Vec3 normal_of(const std::array<Vec3, 3>& triangle);

/// The colour of a face with that normal of any length, lit from beside the viewer; the colour
/// itself where the normal is zero.
[[nodiscard]] Colour lit(const Colour& colour, const Vec3& normal, const View& view);

/// Mixes two colours: share 0 gives `one`, share 1 gives `other`.
[[nodiscard]] Colour mixed(const Colour& one, const Colour& other, double share);

/// Points with normal . p <= offset stay.
struct CutPlane {
  Vec3 normal;
  double offset = 0;

  [[nodiscard]] double height(const Vec3& p) const { return normal.dot(p) - offset; }
};

/// A convex polygon of three or four corners, or nothing.
struct Piece {
  std::array<Vec3, 4> corners;
  std::size_t count = 0;

  void add(const Vec3& corner) { corners[count++] = corner; }
};

/// The part of a triangle that stays, in its orientation.
[[nodiscard]] Piece clipped(const std::array<Vec3, 3>& triangle, const CutPlane& plane);

/// The part of the plane that is in the tet.  Where faces of tets lie in the plane, only the tets
/// beyond it have them, so that the pieces of a mesh cover its cut once.
[[nodiscard]] Piece cross_section(const std::array<Vec3, 4>& tet, const CutPlane& plane);

}  // namespace mw::picture
