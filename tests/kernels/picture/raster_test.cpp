// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The rasteriser against brute force.
#include "kernels/picture/raster.h"
#include "tests/testing.h"

namespace mw::picture {
namespace {

constexpr int kSide = 24;  // pixels of a small picture

using Pixels = std::vector<std::uint8_t>;

/// Returns the whole picture, drawn in bands of `rows` rows.
Pixels picture_of(const std::vector<ScreenTriangle>& triangles, int samples, int rows = kSide) {
  Pixels out;
  for (int first = 0; first < kSide; first += rows) {
    const Band band{kSide, first, std::min(rows, kSide - first)};
    Raster raster(band, samples);
    for (const ScreenTriangle& triangle : triangles) raster.draw(triangle);
    for (int y = 0; y < band.rows; ++y) {
      Pixels row(4 * kSide);
      raster.read_row(y, row);
      out.insert(out.end(), row.begin(), row.end());
    }
  }
  return out;
}

std::size_t index_of(int x, int y) {
  return 4 * (static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x));
}

bool is_drawn(const Pixels& pixels, int x, int y) {
  return pixels[index_of(x, y) + 3] != 0;
}

/// Places on the grid of 1 / steps, so that sides often go through centres of pixels.
class Places {
 public:
  Places(unsigned seed, int steps) : random_(seed), steps_(steps) {}

  ScreenPoint point() {
    std::uniform_int_distribution<int> position(-2 * steps_, (kSide + 2) * steps_);
    std::uniform_real_distribution<double> depth(0, 1);
    const double x = position(random_), y = position(random_);
    return {x / steps_, y / steps_, depth(random_)};
  }
  ScreenTriangle triangle() {
    std::uniform_int_distribution<int> part(0, 255);
    const auto colour = [&] {
      return Colour{static_cast<std::uint8_t>(part(random_)),
                    static_cast<std::uint8_t>(part(random_)),
                    static_cast<std::uint8_t>(part(random_))};
    };
    return {.corners = {point(), point(), point()},
            .lined = {true, false, true},
            .face = colour(),
            .line = colour(),
            .line_width = 1.5};
  }
  std::mt19937& random() { return random_; }

 private:
  std::mt19937 random_;
  int steps_;
};

double turn(const ScreenPoint& a, const ScreenPoint& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

TEST(Raster, TriangleCoversThePixelsWhoseCentresAreInside) {
  Places positions(1, 2);
  int inside_any = 0;
  for (int round = 0; round < 300; ++round) {
    const ScreenTriangle triangle = positions.triangle();
    const Pixels pixels = picture_of({triangle}, 1);
    const auto& [a, b, c] = triangle.corners;
    const double area = turn(a, b, c.x, c.y);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double min = std::min(
            {turn(a, b, px, py) * area, turn(b, c, px, py) * area, turn(c, a, px, py) * area});
        if (area == 0 || min < 0) {
          ASSERT_FALSE(is_drawn(pixels, x, y)) << round << ": " << x << ", " << y;
        } else if (min > 0) {
          ASSERT_TRUE(is_drawn(pixels, x, y)) << round << ": " << x << ", " << y;
          ++inside_any;
        }
      }
    }
  }
  EXPECT_GT(inside_any, 1000);
}

TEST(Raster, SharedSidesLeaveNoGapAndNoOverlap) {
  Places positions(2, 2);
  const double end = kSide;
  const std::vector<ScreenPoint> ring{{0, 0}, {end, 0}, {end, end}, {0, end}};
  for (int round = 0; round < 100; ++round) {
    ScreenPoint middle = positions.point();
    middle.x = std::clamp(middle.x, 0.0, end);
    middle.y = std::clamp(middle.y, 0.0, end);
    std::vector<int> count(kSide * kSide);
    for (std::size_t i = 0; i < 4; ++i) {
      const Pixels pixels = picture_of({{.corners = {middle, ring[i], ring[(i + 1) % 4]}}}, 1);
      for (std::size_t at = 0; at < count.size(); ++at) count[at] += pixels[4 * at + 3] == 255;
    }
    EXPECT_TRUE(std::all_of(count.begin(), count.end(), [](int n) { return n == 1; })) << round;
  }
}

TEST(Raster, NearestTriangleWins) {
  Places positions(3, 256);
  for (int round = 0; round < 50; ++round) {
    std::vector<ScreenTriangle> triangles;
    for (int i = 0; i < 5; ++i) {
      ScreenTriangle triangle = positions.triangle();
      triangle.line_width = 0;
      for (ScreenPoint& corner : triangle.corners) corner.depth = 0.1 * (i + 1);
      triangles.push_back(triangle);
    }
    Pixels expected(4 * kSide * kSide);
    for (std::size_t i = triangles.size(); i-- > 0;) {
      const Pixels alone = picture_of({triangles[i]}, 1);
      for (std::size_t at = 0; at < alone.size(); at += 4) {
        if (alone[at + 3] != 0) std::copy_n(&alone[at], 4, &expected[at]);
      }
    }
    std::shuffle(triangles.begin(), triangles.end(), positions.random());
    EXPECT_EQ(picture_of(triangles, 1), expected) << round;
  }
}

TEST(Raster, OrderCornersAndBandsDoNotMatter) {
  Places positions(4, 3);
  for (int round = 0; round < 30; ++round) {
    std::vector<ScreenTriangle> triangles;
    for (int i = 0; i < 8; ++i) triangles.push_back(positions.triangle());
    triangles.push_back(triangles[0]);  // as near as another
    triangles.back().face = {9, 9, 9};
    const Pixels expected = picture_of(triangles, 3);
    std::shuffle(triangles.begin(), triangles.end(), positions.random());
    for (ScreenTriangle& triangle : triangles) {
      std::rotate(triangle.corners.begin(), triangle.corners.begin() + 1, triangle.corners.end());
      std::rotate(triangle.lined.begin(), triangle.lined.begin() + 1, triangle.lined.end());
      std::swap(triangle.corners[0], triangle.corners[1]);
      std::swap(triangle.lined[0], triangle.lined[1]);
    }
    EXPECT_EQ(picture_of(triangles, 3, 5), expected) << round;
  }
}

TEST(Raster, LinesAreAsWideAsAskedAndOnlyWhereAsked) {
  const ScreenPoint a{0, 0, 0}, b{20, 0, 0}, c{0, 20, 0};
  const Pixels pixels = picture_of({{.corners = {a, b, c},
                                     .lined = {false, true, false},  // a c: x = 0
                                     .face = {10, 20, 30},
                                     .line = {200, 100, 50},
                                     .line_width = 4}},
                                   1);
  for (int y = 0; y < 15; ++y) {
    for (int x = 0; x < 19 - y; ++x) {
      const std::uint8_t red = pixels[index_of(x, y)];
      EXPECT_EQ(red, x < 2 ? 200 : 10) << x << ", " << y;
    }
  }
}

TEST(Raster, AlphaIsTheShareOfThePixel) {
  // Covers the left third of the pixels in column 3.
  const double x = 3 + 1.0 / 3;
  const Pixels pixels =
      picture_of({{.corners = {{{0, -60}, {x, 0}, {0, 60}}}, .face = {90, 91, 92}},
                  {.corners = {{{x, -100}, {x, 100}, {0, 0}}}, .face = {90, 91, 92}}},
                 3);
  const std::uint8_t* const pixel = &pixels[4 * 3];
  EXPECT_EQ(pixel[0], 90);
  EXPECT_EQ(pixel[1], 91);
  EXPECT_EQ(pixel[2], 92);
  EXPECT_EQ(pixel[3], 85);
}

}  // namespace
}  // namespace mw::picture
