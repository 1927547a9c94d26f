// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rows of labels from the top, directions and the scale bar at the bottom.
#include "engine/picture/legend.h"

#include <algorithm>
#include <cmath>

#include "engine/picture/draw.h"
#include "engine/report/figures.h"
#include "io/labels/label_table.h"
#include "kernels/core/elementary.h"

namespace mw::picture {
namespace {

constexpr int kSwatch = 13, kGap = 6;     // in pixels of the letters
constexpr int kArm = 34, kBarHeight = 4;  // in the same
constexpr std::size_t kLeastLetters = 11;

double volume_of(io::GroupedMesh& mesh, const io::RowRange& tets) {
  double out = 0;
  for (std::uint64_t number = tets.begin; number < tets.end; ++number) {
    const auto [a, b, c, d] = mesh.tet(number);
    const auto at = [&](std::uint64_t row) {
      const io::Position p = mesh.node(row);
      return Vec3(p[0], p[1], p[2]);
    };
    const Vec3 corner = at(a);
    out += std::abs((at(b) - corner).cross(at(c) - corner).dot(at(d) - corner));
  }
  return out;
}

/// Returns a length of 1, 2 or 5 times a power of ten, not above another one.
double round_length(double most) {
  double out = power_of_ten_below(most);
  for (const double step : {5.0, 2.0}) {
    if (step * out <= most) return step * out;
  }
  return out;
}

/// Returns the letters of the ends of the world's axes, the beginning of each first; without a
/// frame the axes' own.
std::array<std::u32string_view, 3> ends_of(io::WorldFrame frame) {
  if (frame == io::WorldFrame::kRas) return {U"LR", U"PA", U"IS"};
  if (frame == io::WorldFrame::kLps) return {U"RL", U"AP", U"IS"};
  return {U" x", U" y", U" z"};
}

}  // namespace

Legend legend_of(io::GroupedMesh& mesh, const std::vector<bool>& shown,
                 const io::LabelNames& names) {
  std::vector<std::pair<double, Label>> sizes;
  for (Label rank = 0; rank < shown.size(); ++rank) {
    if (shown[rank]) sizes.emplace_back(-volume_of(mesh, mesh.label_tets()[rank]), rank);
  }
  std::sort(sizes.begin(), sizes.end());
  const io::MeshRecord& record = mesh.header().record;
  Legend out{.rows = {}, .labels = sizes.size(), .frame = record.frame, .unit = record.unit};
  sizes.resize(std::min(sizes.size(), Legend::kMostRows));
  for (const auto& [size, rank] : sizes) {
    const RawLabel raw = mesh.table().raw(rank);
    const std::string& name = names.name(raw);
    out.rows.push_back(
        {.colour = label_colour(raw, names),
         .text = name.empty() ? io::label_text(raw, mesh.table().is_signed()) : name});
  }
  return out;
}

LegendColumn::LegendColumn(const Legend& legend, int width, int height, int scale)
    : legend_(legend), width_(width), height_(height) {
  if (width < kLeastWidth || height < kLeastHeight) return;
  scale_ = scale > 0 ? scale : std::clamp(std::min(width / 1000, height / 750), 1, 8);
  const int most = (width * 3 / 10 - scale_ * (kSwatch + kGap) - 2 * pad()) / text_width(1);
  letters_ = kLeastLetters;
  for (const LegendRow& row : legend.rows) {
    letters_ = std::max(letters_, letters_of(row.text).size());
  }
  letters_ = std::min(letters_, static_cast<std::size_t>(std::max(most, 1)));
  column_ = text_width(letters_) + scale_ * (kSwatch + kGap) + 2 * pad();
}

int LegendColumn::text_width(std::size_t letters) const {
  return scale_ * kGlyphWidth * static_cast<int>(letters);
}

Pixel LegendColumn::middle_of_directions() const {
  const int bottom = height_ - pad() - line_height() - scale_ * kBarHeight - pad();
  const int reach = scale_ * (kArm + kGlyphHeight);
  return {static_cast<double>(left() + reach), static_cast<double>(bottom - reach)};
}

Overlay LegendColumn::marks(const Camera& camera, const View& view, const Colour& ink) const {
  Overlay out;
  if (column_ == 0) return out;
  add_rows(ink, out);
  add_bar(camera.pixels_a_unit(), ink, out);
  add_directions(view, ink, out);
  return out;
}

void LegendColumn::add_rows(const Colour& ink, Overlay& out) const {
  const double end = middle_of_directions().y - scale_ * (kArm + kGlyphHeight) - pad();
  const auto room = static_cast<std::size_t>(std::max(end - pad(), 0.0) / line_height());
  if (room == 0) return;
  const bool has_all = legend_.labels <= std::min(room, legend_.rows.size());
  const std::size_t count = has_all ? legend_.labels : std::min(room, legend_.rows.size()) - 1;
  int y = pad();
  const int text_left = left() + scale_ * (kSwatch + kGap);
  for (std::size_t i = 0; i < count; ++i, y += line_height()) {
    const LegendRow& row = legend_.rows[i];
    std::u32string text = letters_of(row.text);
    if (text.size() > letters_) text = text.substr(0, letters_ - 1) + U"\u00bb";
    const int top = y + scale_;
    out.add_box(left(), top, left() + scale_ * kSwatch, top + scale_ * kSwatch, row.colour);
    out.add_text(text_left, y, scale_, text, ink);
  }
  if (has_all) return;
  out.add_text(text_left, y, scale_,
               letters_of("and " + std::to_string(legend_.labels - count) + " more"), ink);
}

void LegendColumn::add_bar(double pixels_a_unit, const Colour& ink, Overlay& out) const {
  const int room = column_ - 2 * pad();
  if (!(pixels_a_unit > 0) || !std::isfinite(pixels_a_unit)) return;
  const double length = round_length(room / pixels_a_unit);
  const int pixels = std::max(static_cast<int>(std::lround(length * pixels_a_unit)), 1);
  const int bottom = height_ - pad(), top = bottom - scale_ * kBarHeight;
  out.add_box(left(), top, left() + pixels, bottom, ink);
  const std::string text =
      report::short_number(length) + (legend_.unit.empty() ? "" : " " + legend_.unit);
  out.add_text(left(), top - line_height(), scale_, letters_of(text), ink);
}

void LegendColumn::add_directions(const View& view, const Colour& ink, Overlay& out) const {
  const auto ends = ends_of(legend_.frame);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    for (const int sign : {-1, 1}) {
      const std::u32string_view letter = ends[axis].substr(sign < 0 ? 0 : 1, 1);
      const Pixel along{sign * view.right[k], -sign * view.up[k]};
      constexpr double kShortest = 0.3;  // shorter ones point to the viewer or away
      const bool is_short = along.x * along.x + along.y * along.y < kShortest * kShortest;
      if (letter == U" " || is_short) continue;
      const bool is_behind = sign * view.viewer[k] < 0;
      add_direction(along, letter, is_behind ? mixed(ink, {160, 160, 160}, 0.6) : ink, out);
    }
  }
}

void LegendColumn::add_direction(const Pixel& along, std::u32string_view letter, const Colour& ink,
                                 Overlay& out) const {
  constexpr double kLineWidth = 1.6;
  const Pixel middle = middle_of_directions();
  const double arm = scale_ * kArm, length = std::sqrt(along.x * along.x + along.y * along.y);
  const Pixel tip{middle.x + arm * along.x, middle.y + arm * along.y};
  out.add_line(middle, tip, scale_ * kLineWidth, ink);
  const double beyond = scale_ * kGlyphHeight * 0.6 / length;
  const double x = tip.x + beyond * along.x - scale_ * kGlyphWidth / 2.0;
  const double y = tip.y + beyond * along.y - scale_ * kGlyphHeight / 2.0;
  out.add_text(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)), scale_, letter,
               ink);
}

}  // namespace mw::picture
