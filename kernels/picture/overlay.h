// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Flat marks above a picture: boxes, lines and text.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "kernels/picture/glyphs.h"
#include "kernels/picture/raster.h"

namespace mw::picture {

/// A place in pixels, from the left and the top.
struct Pixel {
  double x = 0;
  double y = 0;
};

/// Lines lie under boxes and text; of two of a kind the later one is above.  All that decides is in
/// whole numbers, or in double by + - * / and sqrt alone, as in Raster.
class Overlay {
 public:
  /// Fills the pixels from x0, y0 to before x1, y1.
  void add_box(int x0, int y0, int x1, int y1, const Colour& colour);
  /// Draws a line that is `width` pixels wide, with smooth edges.
  void add_line(const Pixel& from, const Pixel& to, double width, const Colour& colour);
  /// Writes a text whose upper left corner is there, each of its pixels `scale` pixels wide.
  void add_text(int x, int y, int scale, std::u32string_view text, const Colour& colour);

  /// Lays the marks over row y of a picture: red, green, blue, alpha, not multiplied by alpha.
  void blend(int y, std::span<std::uint8_t> row) const;

 private:
  struct Box {
    int x0, y0, x1, y1;
    Colour colour;
  };
  struct Line {
    Pixel from, to;
    double width;
    Colour colour;
  };

  static void blend_line(const Line& line, int y, std::span<std::uint8_t> row);

  std::vector<Box> boxes_;
  std::vector<Line> lines_;
};

}  // namespace mw::picture
