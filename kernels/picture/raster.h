// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Draws triangles into a band of a picture, with a z-buffer, thin lines and smooth edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mw::picture {

/// Red, green, blue, each 0 to 255.
using Colour = std::array<std::uint8_t, 3>;

/// Where a point is seen: pixels from the left and the top, and depth from 0 (near) to 1 (far).
struct ScreenPoint {
  double x = 0;
  double y = 0;
  double depth = 0;
};

struct ScreenTriangle {
  std::array<ScreenPoint, 3> corners;
  std::array<bool, 3> lined{};  ///< whether the side opposite to this corner gets a line
  Colour face{};
  Colour line{};
  double line_width = 0;  ///< pixels; half of it lies in this triangle, the rest in its neighbour
};

/// Rows first .. first + rows - 1 of a picture that is `width` pixels wide.
struct Band {
  int width = 0;
  int first = 0;
  int rows = 0;
};

/// A picture of opaque triangles, each pixel the mean of samples^2 points in it.
/// Corners are rounded to 1/256 of a sample, and all else that decides is in whole numbers, or in
/// double by + - * / and sqrt alone, so that every machine draws the same pixels.  A sample is in a
/// triangle when its centre is; a centre on a side counts if that is an upper or left side, so that
/// triangles that share a side leave no gap and no overlap.  The nearest triangle wins, and of
/// equally near ones that of the least colour.  So neither the order of triangles and of their
/// corners matters nor how the picture is cut into bands.
/// Memory: 8 bytes a sample of the band.
class Raster {
 public:
  /// The largest |x| and |y| that a corner may have, in pixels.
  static constexpr double kMaxPixels = 32768;

  /// REQUIRES: samples from 1 to 4.
  explicit Raster(const Band& band, int samples = 3);

  /// REQUIRES: |x|, |y| <= kMaxPixels; depth in [0, 1].
  void draw(const ScreenTriangle& triangle);

  /// Writes a row of the band as red, green, blue, alpha; what no triangle covers is transparent,
  /// and colours are not multiplied by alpha.  REQUIRES: row < rows, out.size() == 4 * width.
  void read_row(int row, std::span<std::uint8_t> out) const;

 private:
  struct Sample {
    std::uint32_t depth = 0xffffffffU;  ///< this depth stands for no triangle
    std::uint32_t colour = 0;           ///< red << 16 | green << 8 | blue
  };

  Band band_;
  int samples_;
  std::vector<Sample> buffer_;  ///< rows of samples
};

}  // namespace mw::picture
