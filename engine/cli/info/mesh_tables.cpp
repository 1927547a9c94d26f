// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// `mwmesh info` of a mesh as tables of text.
#include "engine/cli/info/mesh_tables.h"

#include <array>

#include "engine/cli/options/values.h"

namespace mw::cli {
namespace {

std::string number(Digits digits, double value) {
  if (digits == Digits::kAll) return format_number(value);
  return format_figure(value);
}

using Fields = std::vector<std::string>;

void add_fields(Fields& row, std::initializer_list<std::string> fields) {
  row.insert(row.end(), fields);
}

void add_position(Fields& row, const io::Position& p, Digits digits) {
  for (const double x : p) row.push_back(number(digits, x));
}

/// Returns whether a table for people has millilitres: the volume tells that lengths are in mm.
bool shows_millilitres(const MeshInfo& facts, Digits digits) {
  return digits == Digits::kFour && facts.volume && facts.volume->unit == "mm";
}

Fields label_titles(const MeshInfo& facts, Digits digits) {
  Fields titles{"label", "name", shows_millilitres(facts, digits) ? "mm3" : "volume"};
  if (shows_millilitres(facts, digits)) titles.push_back("mL");
  if (facts.volume) add_fields(titles, {"voxels", "volume_error"});
  add_fields(titles, {"area", "area_on_box", "tets"});
  if (facts.mesh.labels.empty() || facts.mesh.labels.front().betti) {
    add_fields(titles, {"components", "b0", "b1", "b2"});
  }
  add_fields(titles, {"rr_min", "rr_mean"});
  return titles;
}

Fields label_fields(const MeshInfo& facts, Label rank, Digits digits) {
  const LabelStats& label = facts.mesh.labels[rank];
  const RawLabel raw = facts.table.raw(rank);
  Fields row{format_label(raw, facts.table.is_signed()), facts.names.name(raw),
             number(digits, label.volume)};
  if (shows_millilitres(facts, digits)) row.push_back(number(digits, label.volume / 1000));
  if (facts.volume) {
    const auto voxels = voxels_of(facts, rank);
    row.push_back(voxels ? std::to_string(voxels->voxels) : "0");
    row.push_back(voxels ? number(digits, voxels->error) : "");
  }
  add_fields(row, {number(digits, label.area), number(digits, label.area_on_box),
                   std::to_string(label.tets)});
  if (label.betti) {
    add_fields(row,
               {std::to_string(label.betti->open.b0), std::to_string(label.betti->closed.b0),
                std::to_string(label.betti->closed.b1), std::to_string(label.betti->closed.b2)});
  }
  add_fields(row,
             {number(digits, label.radius_ratio_min), number(digits, label.radius_ratio_mean)});
  return row;
}

constexpr std::array kJunctionTitles{"lo_x", "lo_y",       "lo_z",       "hi_x",      "hi_y",
                                     "hi_z", "centroid_x", "centroid_y", "centroid_z"};

Fields place_fields(const LabelStats& label, Digits digits) {
  Fields row;
  for (const io::Position& p : {label.lo, label.hi, label.centroid}) add_position(row, p, digits);
  return row;
}

Fields titles_of(const MeshInfo& facts, Digits digits, LabelColumns columns) {
  Fields titles = columns == LabelColumns::kPlaces ? Fields{"label"} : label_titles(facts, digits);
  if (columns == LabelColumns::kSizes) return titles;
  titles.insert(titles.end(), kJunctionTitles.begin(), kJunctionTitles.end());
  return titles;
}

Fields fields_of(const MeshInfo& facts, Label rank, Digits digits, LabelColumns columns) {
  Fields row = label_fields(facts, rank, digits);
  if (columns == LabelColumns::kSizes) return row;
  if (columns == LabelColumns::kPlaces) row.resize(1);
  const Fields position = place_fields(facts.mesh.labels[rank], digits);
  row.insert(row.end(), position.begin(), position.end());
  return row;
}

}  // namespace

TextTable label_table(const MeshInfo& facts, Digits digits, LabelColumns columns) {
  TextTable table{titles_of(facts, digits, columns)};
  for (Label rank = 0; rank < facts.table.size(); ++rank) {
    table.push_back(fields_of(facts, rank, digits, columns));
  }
  return table;
}

TextTable contact_table(const MeshInfo& facts, Digits digits) {
  Fields titles{"first", "second", "triangles", "area"};
  if (facts.volume) titles.emplace_back("voxel_area");
  TextTable table{titles};
  for (const Contact& c : contacts_of(facts)) {
    const bool is_signed = facts.table.is_signed();
    Fields row{format_label(c.first, is_signed), format_label(c.second, is_signed),
               std::to_string(c.triangles), number(digits, c.area)};
    if (c.voxel_area) row.push_back(number(digits, *c.voxel_area));
    table.push_back(row);
  }
  return table;
}

}  // namespace mw::cli
