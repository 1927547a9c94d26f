// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What stands beside a picture: the largest labels by name, a scale bar, and directions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/mesh/grouped/grouped_mesh.h"
#include "io/volume/volume_space.h"
#include "kernels/picture/overlay.h"
#include "kernels/picture/view.h"

namespace mw::picture {

struct LegendRow {
  Colour colour{};
  std::string text;  ///< the label's name, or else its number
};

struct Legend {
  static constexpr std::size_t kMostRows = 64;

  std::vector<LegendRow> rows;  ///< the largest labels by volume, the largest first
  std::size_t labels = 0;       ///< how many are shown
  io::WorldFrame frame = io::WorldFrame::kOwn;
  std::string unit;  ///< of lengths; empty if unknown
};

/// shown says by rank of label which labels are seen; names have names and colours.
/// ERRORS: see GroupedMesh.  Cost: a pass over the tets of these labels.
[[nodiscard]] Legend legend_of(io::GroupedMesh& mesh, const std::vector<bool>& shown,
                               const io::LabelNames& names);

/// Puts a legend into a column on the right of a picture.
class LegendColumn {
 public:
  /// Pictures that are smaller have no column.
  static constexpr int kLeastWidth = 360, kLeastHeight = 270;

  /// scale is how many pixels a pixel of the letters is wide; 0 chooses it by the picture's size.
  LegendColumn(const Legend& legend, int width, int height, int scale);

  /// Returns how many pixels are left for the scene.
  [[nodiscard]] int scene_width() const { return width_ - column_; }
  /// REQUIRES: the camera's picture is scene_width() wide.
  [[nodiscard]] Overlay marks(const Camera& camera, const View& view, const Colour& ink) const;

 private:
  void add_rows(const Colour& ink, Overlay& out) const;
  void add_bar(double pixels_a_unit, const Colour& ink, Overlay& out) const;
  void add_directions(const View& view, const Colour& ink, Overlay& out) const;
  void add_direction(const Pixel& along, std::u32string_view letter, const Colour& ink,
                     Overlay& out) const;
  [[nodiscard]] int text_width(std::size_t letters) const;
  [[nodiscard]] int line_height() const { return scale_ * (kGlyphHeight + 4); }
  [[nodiscard]] int pad() const { return scale_ * 10; }
  [[nodiscard]] int left() const { return scene_width() + pad() / 2; }
  [[nodiscard]] Pixel middle_of_directions() const;

  const Legend& legend_;
  int width_, height_;
  int scale_;
  int column_ = 0;
  std::size_t letters_ = 0;  ///< that a row has room for
};

}  // namespace mw::picture
