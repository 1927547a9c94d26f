// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces as binary .ply files.
#include "io/surface/ply_sink.h"

#include <limits>

#include "io/file/errors.h"
#include "io/mesh/medit/medit.h"

namespace mw::io {
namespace {

constexpr std::string_view kColours =
    "property uchar red\nproperty uchar green\nproperty uchar blue\n";
constexpr std::string_view kOnVertices = "property int label\n";
constexpr std::string_view kOnFaces =
    "property int label_in\nproperty int label_out\nproperty uchar side\n";

}  // namespace

void PlySink::begin(const SurfaceHeader& header) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::int32_t>::max();
  check_max(name_, "vertices", header.vertices(), kMax);
  header_ = header;
  numbers_.emplace(header.labels->table, NumberRange{.min = 0});
  cursor_.emplace(header_);
  colours_ = has_colours(header);
  of_labels_ = std::all_of(header.shells.begin(), header.shells.end(),
                           [](const SurfaceShell& shell) { return shell.label.has_value(); });
  const std::string_view colours = colours_ ? kColours : "";
  file_.append(std::string_view("ply\nformat binary_little_endian 1.0\n"));
  append_comments();
  file_.append(text("element vertex ", header.vertices(),
                    "\nproperty double x\nproperty double y\nproperty double z\n"));
  if (of_labels_) file_.append(text(kOnVertices, colours));
  file_.append(
      text("element face ", header.triangles(), "\nproperty list uchar int vertex_indices\n"));
  if (!of_labels_) file_.append(text(kOnFaces, colours));
  file_.append(std::string_view("end_header\n"));
}

void PlySink::append_comments() {
  for (const std::string& comment :
       {std::string("mwmesh"), shift_comment(header_), space_comment(header_)}) {
    if (!comment.empty()) file_.append("comment " + comment + "\n");
  }
  const LabelTable& table = header_.labels->table;
  for (const Label rank : ranks_of(header_)) {
    const RawLabel raw = table.raw(rank);
    if (const LabelName* row = header_.labels->names.find(raw)) {
      // The '#' of Medit's format is left out.
      file_.append("comment" + medit_comment(*row, table.is_signed()).substr(1));
    }
    const std::int64_t number = (*numbers_)[rank];
    if (static_cast<RawLabel>(number) != raw) {
      file_.append(
          text("comment number ", number, " is label ", label_text(raw, table.is_signed()), "\n"));
    }
  }
}

void PlySink::append_number(Label rank) {
  append_little(file_, static_cast<std::int32_t>((*numbers_)[rank]));
}

void PlySink::append_colour(Label rank) {
  if (!colours_) return;
  const Colour colour = header_.labels->colour(rank);
  for (std::size_t i = 0; i < 3; ++i) append_little(file_, colour[i]);
}

void PlySink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    for (const double x : position) append_little(file_, x);
    if (!of_labels_) continue;
    while (shell_vertex_ == header_.shells[shell_].vertices) {
      ++shell_;
      shell_vertex_ = 0;
    }
    ++shell_vertex_;
    append_number(*header_.shells[shell_].label);
    append_colour(*header_.shells[shell_].label);
  }
}

void PlySink::write_triangles(std::span<const Triangle> triangles) {
  for (const Triangle& triangle : triangles) {
    append_little(file_, std::uint8_t{3});
    for (const std::uint64_t vertex : triangle) {
      append_little(file_, static_cast<std::int32_t>(vertex));
    }
    if (of_labels_) continue;
    cursor_->next();
    const SurfaceRun& run = cursor_->run();
    append_number(run.inside);
    if (run.side == Side::kInterface) {
      append_number(run.outside);
    } else {
      append_little(file_, std::int32_t{0});
    }
    append_little(file_, static_cast<std::uint8_t>(run.side));
    append_colour(run.inside);
  }
}

}  // namespace mw::io
