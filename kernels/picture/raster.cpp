// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Edge functions in whole numbers.
#include "kernels/picture/raster.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "kernels/core/assert.h"

namespace mw::picture {
namespace {

constexpr std::int64_t kUnits = 256;  // in a sample's side
constexpr double kDepthSteps = 2147483648.0;

struct Corner {
  std::int64_t x = 0;
  std::int64_t y = 0;
  double depth = 0;
  bool lined = false;

  [[nodiscard]] auto key() const { return std::tuple(x, y, depth, lined); }
};

/// A side of a triangle; at() is positive on the inner side if the triangle is positive.
struct Side {
  Side(const Corner& from, const Corner& to)
      : x(from.x), y(from.y), dx(to.x - from.x), dy(to.y - from.y) {}

  [[nodiscard]] std::int64_t at(std::int64_t px, std::int64_t py) const {
    return dx * (py - y) - dy * (px - x);
  }
  /// Whether samples on the side belong to the triangle.
  [[nodiscard]] bool has_its_points() const { return dy < 0 || (dy == 0 && dx > 0); }

  std::int64_t x, y, dx, dy;
};

std::uint32_t word_of(const Colour& colour) {
  return static_cast<std::uint32_t>(colour[0]) << 16U |
         static_cast<std::uint32_t>(colour[1]) << 8U | colour[2];
}

std::int64_t to_units(double pixels, int samples) {
  return std::llround(pixels * samples * static_cast<double>(kUnits));
}

/// Returns the corners sorted, then turned so that the area is positive: what is computed of a
/// triangle does not depend on which corner comes first.
std::array<Corner, 3> sorted_corners(const ScreenTriangle& triangle, int samples) {
  std::array<Corner, 3> out;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenPoint& p = triangle.corners[i];
    out[i] = {to_units(p.x, samples), to_units(p.y, samples), p.depth, triangle.lined[i]};
  }
  std::sort(out.begin(), out.end(),
            [](const Corner& a, const Corner& b) { return a.key() < b.key(); });
  if (Side(out[0], out[1]).at(out[2].x, out[2].y) < 0) std::swap(out[1], out[2]);
  return out;
}

/// Answers for one triangle what its samples ask: coverage, line and depth.
class Coverage {
 public:
  Coverage(const ScreenTriangle& triangle, int samples)
      : corners_(sorted_corners(triangle, samples)),
        sides_{Side(corners_[1], corners_[2]), Side(corners_[2], corners_[0]),
               Side(corners_[0], corners_[1])},
        area_(sides_[0].at(corners_[0].x, corners_[0].y)) {
    const double half_width = triangle.line_width / 2 * samples * static_cast<double>(kUnits);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto dx = static_cast<double>(sides_[i].dx), dy = static_cast<double>(sides_[i].dy);
      min_[i] = sides_[i].has_its_points() ? 0 : 1;
      if (corners_[i].lined) lined_[i] = half_width * std::sqrt(dx * dx + dy * dy);
    }
  }

  [[nodiscard]] bool empty() const { return area_ == 0; }

  /// First and last of the samples along an axis (0: x) whose centres may be inside.
  [[nodiscard]] std::array<std::int64_t, 2> range(std::size_t axis) const {
    const auto of = [&](std::size_t i) { return axis == 0 ? corners_[i].x : corners_[i].y; };
    const auto [low, high] = std::minmax({of(0), of(1), of(2)});
    // Shifts round down, negative numbers too.
    return {(low + kUnits / 2 - 1) >> 8, (high - kUnits / 2) >> 8};
  }

  /// Looks at the sample in that column and row; false when its centre is outside.
  bool ask(std::int64_t column, std::int64_t row) {
    const std::int64_t x = column * kUnits + kUnits / 2, y = row * kUnits + kUnits / 2;
    on_line_ = false;
    for (std::size_t i = 0; i < 3; ++i) {
      weights_[i] = sides_[i].at(x, y);
      if (weights_[i] < min_[i]) return false;
      on_line_ = on_line_ || static_cast<double>(weights_[i]) < lined_[i];
    }
    return true;
  }

  /// Line and depth at the sample that was asked for last.
  [[nodiscard]] bool on_line() const { return on_line_; }
  [[nodiscard]] std::uint32_t depth() const {
    const double z = corners_[0].depth;
    const double along = static_cast<double>(weights_[1]) * (corners_[1].depth - z) +
                         static_cast<double>(weights_[2]) * (corners_[2].depth - z);
    const double depth = (z + along / static_cast<double>(area_)) * kDepthSteps;
    return static_cast<std::uint32_t>(std::clamp(depth, 0.0, kDepthSteps));
  }

 private:
  std::array<Corner, 3> corners_;
  std::array<Side, 3> sides_;  ///< opposite to each corner
  std::int64_t area_;          ///< twice the area
  std::array<std::int64_t, 3> min_{};
  std::array<double, 3> lined_{-1, -1, -1};
  std::array<std::int64_t, 3> weights_{};
  bool on_line_ = false;
};

}  // namespace

Raster::Raster(const Band& band, int samples)
    : band_(band),
      samples_(samples),
      buffer_(static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.rows) *
              static_cast<std::size_t>(samples * samples)) {
  MW_ASSERT(samples >= 1 && samples <= 4);
}

void Raster::draw(const ScreenTriangle& triangle) {
  Coverage coverage(triangle, samples_);
  if (coverage.empty()) return;
  const std::int64_t columns = std::int64_t{band_.width} * samples_;
  const std::int64_t first = std::int64_t{band_.first} * samples_;
  const std::int64_t end = first + std::int64_t{band_.rows} * samples_;
  const auto [left, right] = coverage.range(0);
  const auto [top, bottom] = coverage.range(1);
  const std::uint32_t face = word_of(triangle.face), line = word_of(triangle.line);
  for (std::int64_t y = std::max(top, first); y <= std::min(bottom, end - 1); ++y) {
    Sample* const row = &buffer_[static_cast<std::size_t>((y - first) * columns)];
    for (std::int64_t x = std::max<std::int64_t>(left, 0); x <= std::min(right, columns - 1); ++x) {
      if (!coverage.ask(x, y)) continue;
      const Sample drawn{coverage.depth(), coverage.on_line() ? line : face};
      Sample& there = row[x];
      if (std::tie(drawn.depth, drawn.colour) < std::tie(there.depth, there.colour)) there = drawn;
    }
  }
}

void Raster::read_row(int row, std::span<std::uint8_t> out) const {
  const auto side = static_cast<std::size_t>(samples_);
  const auto width = static_cast<std::size_t>(band_.width);
  const auto first = static_cast<std::size_t>(row) * side * side * width;
  for (std::size_t x = 0; x < width; ++x) {
    std::array<std::uint32_t, 3> sum{};
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < side * side; ++i) {
      const Sample& sample = buffer_[first + i / side * side * width + x * side + i % side];
      if (sample.depth == Sample{}.depth) continue;
      ++count;
      for (std::size_t k = 0; k < 3; ++k) sum[k] += sample.colour >> (16 - 8 * k) & 0xffU;
    }
    const auto all = static_cast<std::uint32_t>(side * side);
    for (std::size_t k = 0; k < 3; ++k) {
      out[4 * x + k] = static_cast<std::uint8_t>(count == 0 ? 0 : (sum[k] + count / 2) / count);
    }
    out[4 * x + 3] = static_cast<std::uint8_t>((255 * count + all / 2) / all);
  }
}

}  // namespace mw::picture
