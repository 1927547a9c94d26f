// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "kernels/picture/overlay.h"

#include <algorithm>
#include <cmath>

namespace mw::picture {
namespace {

/// Lays a colour that covers a share of the pixel over it.
void lay_over(const Colour& colour, double share, std::span<std::uint8_t, 4> pixel) {
  const double below = pixel[3] / 255.0 * (1 - share), alpha = share + below;
  if (alpha <= 0) return;
  for (std::size_t k = 0; k < 3; ++k) {
    const double mixed = (colour[k] * share + pixel[k] * below) / alpha;
    pixel[k] = static_cast<std::uint8_t>(mixed + 0.5);
  }
  pixel[3] = static_cast<std::uint8_t>(255 * alpha + 0.5);
}

std::span<std::uint8_t, 4> pixel_of(std::span<std::uint8_t> row, int x) {
  return row.subspan(4 * static_cast<std::size_t>(x)).first<4>();
}

double distance(const Pixel& from, const Pixel& to, const Pixel& at) {
  const double dx = to.x - from.x, dy = to.y - from.y, length = dx * dx + dy * dy;
  const double along = (at.x - from.x) * dx + (at.y - from.y) * dy;
  const double share = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  const double ex = from.x + share * dx - at.x, ey = from.y + share * dy - at.y;
  return std::sqrt(ex * ex + ey * ey);
}

}  // namespace

void Overlay::add_box(int x0, int y0, int x1, int y1, const Colour& colour) {
  boxes_.push_back({x0, y0, x1, y1, colour});
}

void Overlay::add_line(const Pixel& from, const Pixel& to, double width, const Colour& colour) {
  lines_.push_back({from, to, width, colour});
}

void Overlay::add_text(int x, int y, int scale, std::u32string_view text, const Colour& colour) {
  for (const char32_t letter : text) {
    for (int row = 0; row < kGlyphHeight; ++row) {
      const std::uint16_t bits = glyph_row(letter, row);
      for (int column = 0; column < kGlyphWidth; ++column) {
        if ((bits >> (kGlyphWidth - 1 - column) & 1U) == 0) continue;
        const int left = x + scale * column, top = y + scale * row;
        add_box(left, top, left + scale, top + scale, colour);
      }
    }
    x += scale * kGlyphWidth;
  }
}

void Overlay::blend_line(const Line& line, int y, std::span<std::uint8_t> row) {
  const double reach = line.width / 2 + 1;
  const auto [top, bottom] = std::minmax(line.from.y, line.to.y);
  if (y + 0.5 < top - reach || y + 0.5 > bottom + reach) return;
  const auto [left, right] = std::minmax(line.from.x, line.to.x);
  const int end = std::min(static_cast<int>(right + reach) + 1, static_cast<int>(row.size() / 4));
  for (int x = std::max(static_cast<int>(left - reach), 0); x < end; ++x) {
    const double away = distance(line.from, line.to, {x + 0.5, y + 0.5});
    const double share = std::clamp(line.width / 2 + 0.5 - away, 0.0, 1.0);
    if (share > 0) lay_over(line.colour, share, pixel_of(row, x));
  }
}

void Overlay::blend(int y, std::span<std::uint8_t> row) const {
  const int width = static_cast<int>(row.size() / 4);
  for (const Line& line : lines_) blend_line(line, y, row);
  for (const Box& box : boxes_) {
    if (y < box.y0 || y >= box.y1) continue;
    for (int x = std::max(box.x0, 0); x < std::min(box.x1, width); ++x) {
      lay_over(box.colour, 1, pixel_of(row, x));
    }
  }
}

}  // namespace mw::picture
