// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh info` says of a volume.
#include "engine/cli/info/volume_facts.h"
#include "engine/cli/log.h"

#include "engine/report/mesh_facts.h"

#include <algorithm>
#include <iostream>

#include "engine/cli/info/info_text.h"
#include "engine/labels/reading_tiles.h"
#include "engine/system/crew.h"
#include "io/remote/address.h"
#include "io/volume/open_volume.h"

namespace mw::cli {
namespace {

using io::Json;

constexpr std::size_t kMaxPrinted = 1000;

/// Returns the rows of the matrix that takes places in voxels, (i, j, k, 1), to the world: of their
/// first corners, or `inside` of a voxel behind these.
Json affine_json(const io::VolumeSpace& space, double inside) {
  Json rows = Json::array();
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = space.axes[0][k] * space.spacing[0], y = space.axes[1][k] * space.spacing[1],
                 z = space.axes[2][k] * space.spacing[2];
    rows.push_back({x, y, z, space.origin[k] + inside * (x + y + z)});
  }
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

Json range_json(const Box3& box) {
  return {{"lo", {box.lo.x, box.lo.y, box.lo.z}}, {"hi", {box.hi.x, box.hi.y, box.hi.z}}};
}

/// Returns the voxels as --crop counts them, and as the array does.
Json boxes_json(const io::VolumeInfo& info) {
  const Index3 number = io::first_number(info);
  return {{"crop", range_json({number, number + info.shape})},
          {"array", range_json({info.first, info.first + info.shape})}};
}

Json labels_json(const std::vector<engine::LabelRegion>& regions, bool is_signed) {
  return {{"count", regions.size()},
          {"min", report::label_json(regions.front().label, is_signed)},
          {"max", report::label_json(regions.back().label, is_signed)},
          {"per_label", report::kRows}};
}

Json facts_of(const VolumeRequest& request, const io::VolumeInfo& info,
              const std::vector<engine::LabelRegion>& regions) {
  const io::VolumeSpace& space = info.space;
  return {{"kind", "volume"},
          {"file", request.path.string()},
          {"format", info.format},
          {"type", io::name(info.type)},
          {"shape_xyz", {info.shape.x, info.shape.y, info.shape.z}},
          {"spacing_xyz", space.spacing},
          {"origin_xyz", space.origin},
          {"unit", space.unit.empty() ? Json() : Json(space.unit)},
          {"frame", io::name(space.frame)},
          {"affine", affine_json(space, 0)},
          {"affine_of_centres", affine_json(space, 0.5)},
          {"voxels", info.shape.product()},
          {"labels", regions.empty() ? Json("not read: choose with --scale or --crop")
                                     : labels_json(regions, has_signed_labels(info))}};
}

/// Returns a row for each mask that the labels were made of, with its voxels where they were read.
Json masks_json(const io::VolumeInfo& info, const std::vector<engine::LabelRegion>& regions) {
  Json rows = Json::array();
  for (const io::MaskLabels& mask : info.masks) {
    std::uint64_t voxels = 0;
    for (const engine::LabelRegion& region : regions) {
      if (mask.has(region.label)) voxels += region.voxels;
    }
    Json row{{"name", mask.name}, {"labels", mask.labels}};
    if (!regions.empty()) row["voxels"] = voxels;
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Returns a row for each level of a pyramid.
Json scales_json(const std::vector<io::VolumeScale>& scales) {
  Json rows = Json::array();
  for (const auto& [number, info] : scales) {
    Json row{{"scale", number},
             {"shape_xyz", {info.shape.x, info.shape.y, info.shape.z}},
             {"spacing_xyz", info.space.spacing},
             {"chunk_xyz", {info.chunk.x, info.chunk.y, info.chunk.z}}};
    if (info.offset != Index3{}) row["boxes"] = boxes_json(info);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Returns false for a remote volume that was not narrowed down: it may be too large to be read.
bool reads_labels(const VolumeRequest& request) {
  return !io::is_remote_address(request.path.string()) || request.open.scale || request.open.crop;
}

/// Returns the columns of labels: volumes in cubes of the unit, and in millilitres of mm.
Columns columns_of(const std::string& unit) {
  Columns out{{"label"}, {.title = "name", .needs = "label"}, {"voxels"}};
  out.push_back({.title = unit.empty() ? "volume" : unit + "3", .key = "volume"});
  if (unit == "mm") out.push_back({.title = "mL", .key = "volume", .unit = 1000});
  for (const std::string key : {"lo", "hi"}) {
    for (std::size_t k = 0; k < 3; ++k) out.push_back({key + "_" + "xyz"[k], key, k});
  }
  return out;
}

}  // namespace

VolumeFacts::VolumeFacts(const VolumeRequest& request) {
  const std::unique_ptr<io::LabelVolume> opened = open(request, log_warning);
  engine::SharedReads shared(*opened);
  const io::PreparedInput input(shared, request.steps);
  shared.end();
  info_ = input.volume().info();
  if (reads_labels(request))
    regions_ = engine::label_regions(input.volume(), engine::thread_count(0));
  facts_ = facts_of(request, info_, regions_);
  if (info_.offset != Index3{}) facts_["boxes"] = boxes_json(info_);
  if (!info_.masks.empty()) facts_["masks"] = masks_json(info_, regions_);
  if (input.specks()) facts_["specks"] = report::specks_json(input.specks());
  if (input.slices()) facts_["interpolated"] = report::slices_json(input.slices());
  if (input.welds()) facts_["welds"] = report::welds_json(input.welds());
  if (request.open.scale) return;
  const auto scales = io::scales_of(request.path, open_options(request));
  if (scales.size() > 1) facts_["scales"] = scales_json(scales);
}

Json VolumeFacts::label_row(std::size_t i) const {
  const engine::LabelRegion& region = regions_[i];
  const Index3 first = io::first_number(info_);
  Json row = report::named_row_json(region.label, has_signed_labels(info_), info_.names);
  row["voxels"] = region.voxels;
  row.update(range_json({region.box.lo + first, region.box.hi + first}));
  auto volume = static_cast<double>(region.voxels);
  for (const double edge : info_.space.spacing) volume *= edge;
  row["volume"] = volume;
  report::add_colour(row, region.label, info_.names);
  return row;
}

void print_volume(const VolumeFacts& volume) {
  Json facts = volume.json();
  facts.erase("affine");  // people know the one of centres
  if (volume.labels() > 0) facts["labels"].erase("per_label");
  print_facts(facts);
  const std::size_t shown = std::min(volume.labels(), kMaxPrinted);
  if (shown == 0) return;
  Json rows = Json::array();
  for (std::size_t i = 0; i < shown; ++i) rows.push_back(volume.label_row(i));
  std::cout << '\n';
  print_columns(rows, columns_of(facts["unit"].is_null() ? "" : facts["unit"].text()));
  if (shown == volume.labels()) return;
  std::cout << volume.labels() - shown << " more labels; --json lists all\n";
}

void print_volume_json(const VolumeFacts& volume) {
  if (volume.labels() == 0) {
    std::cout << volume.json().dump_indented() << "\n";
    return;
  }
  const auto for_each_row = [&](const report::TakeRow& take) {
    for (std::size_t i = 0; i < volume.labels(); ++i) take(volume.label_row(i));
  };
  report::append_with_rows(volume.json(), for_each_row,
                           [](std::string_view text) { std::cout << text; });
}

}  // namespace mw::cli
