// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Draws bands of rows, one after the other, with the rasteriser.
#include "engine/picture/draw.h"

#include <algorithm>
#include <cmath>

#include "io/file/errors.h"
#include "kernels/core/error.h"

namespace mw::picture {
namespace {

constexpr int kSamples = 3;
constexpr double kLineWidth = 1.1;  // pixels
constexpr std::int64_t kBandBytes = 64 << 20;
constexpr std::int64_t kSampleBytes = 8;

struct Measured {
  Extent extent;
  std::uint64_t triangles = 0;
};

Measured measure(MeshScene& scene, const View& view) {
  Measured out;
  scene.each([&](const SceneTriangle& triangle) {
    for (const Vec3& corner : triangle.corners) out.extent.add(view, corner);
    ++out.triangles;
  });
  if (out.extent.empty()) {
    throw Error(ErrorKind::kInput,
                "there is nothing to see: no tets of these labels, or none "
                "behind the cut");
  }
  constexpr double kMax = 1e100;  // products of lengths are far from infinite
  if (out.extent.lo.minCoeff() < -kMax || out.extent.hi.maxCoeff() > kMax) {
    throw Error(ErrorKind::kInput, "vertices lie farther out than 1e100; the mesh is damaged");
  }
  return out;
}

/// Returns how dark edges are, 0 to 1, from the average number of pixels of a triangle.
double line_share(const Measured& measured, const PictureStyle& style) {
  constexpr double kFaint = 3, kPlain = 14;  // pixels across
  constexpr double kDarkest = 0.5;
  if (style.lines == Lines::kNone) return 0;
  if (style.lines == Lines::kAll) return kDarkest;
  const double pixels = static_cast<double>(style.width) * style.height;
  const double across = std::sqrt(pixels / static_cast<double>(measured.triangles));
  return kDarkest * std::clamp((across - kFaint) / (kPlain - kFaint), 0.0, 1.0);
}

class Painter {
 public:
  Painter(const Measured& measured, const PictureStyle& style, int width)
      : view_(style.view),
        camera_(style.view, measured.extent, width, style.height),
        line_share_(line_share(measured, style)) {}

  [[nodiscard]] const Camera& camera() const { return camera_; }

  void paint(const SceneTriangle& triangle, Raster& raster) const {
    ScreenTriangle out{.lined = triangle.lined,
                       .face = lit(triangle.colour, triangle.normal, view_),
                       .line_width = line_share_ > 0 ? kLineWidth : 0};
    out.line = mixed(out.face, {0, 0, 0}, line_share_);
    for (std::size_t i = 0; i < 3; ++i) out.corners[i] = camera_.at(triangle.corners[i]);
    raster.draw(out);
  }

 private:
  View view_;
  Camera camera_;
  double line_share_;
};

/// Returns the colour of letters, which can be read on any ground where that is transparent.
Colour ink_of(const PictureStyle& style) {
  return style.transparent ? Colour{128, 128, 128} : Colour{50, 50, 50};
}

int band_rows(const PictureStyle& style) {
  const std::int64_t row = style.width * kSamples * kSamples * kSampleBytes;
  return static_cast<int>(std::clamp<std::int64_t>(kBandBytes / row, 1, style.height));
}

}  // namespace

void check_sides(std::int64_t width, std::int64_t height) {
  constexpr std::int64_t kMin = 16, kMax = 8192;
  if (std::min(width, height) >= kMin && std::max(width, height) <= kMax) return;
  io::fail_usage("expected pixels from 16x16 to 8192x8192, e.g. 1200x900");
}

std::uint64_t draw(MeshScene& scene, const PictureStyle& style, const io::TakeBytes& take) {
  const Measured measured = measure(scene, style.view);
  std::optional<LegendColumn> column;
  if (style.legend) column.emplace(*style.legend, style.width, style.height, style.letters);
  const Painter painter(measured, style, column ? column->scene_width() : style.width);
  const Overlay marks =
      column ? column->marks(painter.camera(), style.view, ink_of(style)) : Overlay();
  io::PngWriter png(static_cast<std::uint32_t>(style.width),
                    static_cast<std::uint32_t>(style.height), style.transparent, take);
  std::vector<std::uint8_t> row(4 * static_cast<std::size_t>(style.width));
  const int rows = band_rows(style);
  for (int first = 0; first < style.height; first += rows) {
    const Band band{style.width, first, std::min(rows, style.height - first)};
    Raster raster(band, kSamples);
    scene.each([&](const SceneTriangle& triangle) { painter.paint(triangle, raster); });
    for (int y = 0; y < band.rows; ++y) {
      raster.read_row(y, row);
      marks.blend(first + y, row);
      png.write_row(row);
    }
  }
  png.finish();
  return measured.triangles;
}

}  // namespace mw::picture
