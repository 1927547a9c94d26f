// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The one interface through which triangles leave the program, with the names of their labels.
#include "io/surface/surface_sink.h"

#include <algorithm>
#include <cmath>

#include "io/file/errors.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/grouped/label_numbers.h"
#include "kernels/core/assert.h"
#include "kernels/core/sort_distinct.h"

namespace mw::io {

Colour SurfaceLabels::colour(Label rank) const {
  const LabelName* const row = names.find(table.raw(rank));
  return row == nullptr ? kPlainColour : row->colour.value_or(kPlainColour);
}

std::shared_ptr<const SurfaceLabels> surface_labels(const GroupedMesh& mesh) {
  const GroupNames names(mesh);
  auto labels = std::make_shared<SurfaceLabels>();
  labels->table = mesh.table();
  labels->names = mesh.names();
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    labels->titles.push_back(names.volume(rank));
  }
  return labels;
}

std::vector<Label> ranks_of(const SurfaceHeader& header) {
  std::vector<Label> ranks;
  for (const SurfaceShell& shell : header.shells) {
    for (const SurfaceRun& run : shell.runs) {
      ranks.push_back(run.inside);
      if (run.side == Side::kInterface) ranks.push_back(run.outside);
    }
  }
  sort_distinct(ranks);
  return ranks;
}

LabelNames names_of(const SurfaceHeader& header) {
  std::vector<LabelName> rows;
  for (const Label rank : ranks_of(header)) {
    const LabelName* const row = header.labels->names.find(header.labels->table.raw(rank));
    if (row != nullptr) rows.push_back(*row);
  }
  return LabelNames(std::move(rows));
}

bool has_colours(const SurfaceHeader& header) {
  const LabelNames names = names_of(header);
  return std::any_of(names.rows().begin(), names.rows().end(),
                     [](const LabelName& row) { return row.colour.has_value(); });
}

std::uint64_t SurfaceHeader::vertices() const {
  std::uint64_t sum = 0;
  for (const SurfaceShell& shell : shells) sum += shell.vertices;
  return sum;
}

std::uint64_t SurfaceHeader::triangles() const {
  std::uint64_t sum = 0;
  for (const SurfaceShell& shell : shells) {
    for (const SurfaceRun& run : shell.runs) sum += run.triangles;
  }
  return sum;
}

std::string space_comment(const SurfaceHeader& header) {
  if (header.frame == WorldFrame::kOwn) return {};
  return header.frame == WorldFrame::kRas ? "SPACE=RAS" : "SPACE=LPS";
}

std::string shift_comment(const SurfaceHeader& header) {
  const auto& [x, y, z] = header.shift;
  if (x == 0 && y == 0 && z == 0) return {};
  return text("SHIFT=", x, ",", y, ",", z);
}

void check_floats(std::string_view file, const SurfaceHeader& header, double scale,
                  const std::string& way_out) {
  constexpr int kBits = 24;
  const double largest = header.largest * scale;
  check_rounding(file, {.largest = largest,
                        .shortest_edge = header.shortest_edge * scale,
                        .loss = std::ldexp(largest, -kBits),
                        .room = text(kBits, " bits"),
                        .way_out = way_out});
}

bool RunCursor::next() {
  bool other = !begun_;
  begun_ = true;
  while (run_ == shell().runs.size() || seen_ == run().triangles) {
    seen_ = 0;
    other = true;
    if (run_ < shell().runs.size()) ++run_;
    if (run_ < shell().runs.size()) continue;
    run_ = 0;
    ++shell_;
    MW_ASSERT(shell_ < header_->shells.size());
  }
  ++seen_;
  return other;
}

void check_max(std::string_view file, std::string_view what, std::uint64_t count,
               std::uint64_t max) {
  if (count <= max) return;
  fail_usage(file, ": ", count, " ", what, " are more than the ", max,
             " that this format can hold; write each label apart");
}

}  // namespace mw::io
