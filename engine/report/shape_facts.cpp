// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Wording of volumes, areas and bends.
#include "engine/report/shape_facts.h"

#include <iostream>

#include "engine/report/figures.h"
#include "engine/report/mesh_facts.h"
#include "engine/report/name_facts.h"
#include "engine/settings/number_text.h"

namespace mw::report {

using io::Json;

namespace {

std::string percent(double share, int digits) {
  return format_fixed(100 * share, digits) + " %";
}

}  // namespace

Json volume_summary_json(const audit::VolumeSummary& volumes, const io::LabelTable& table) {
  Json out{{"volume_error_mean_abs", nullptr},
           {"volume_error_max_abs", nullptr},
           {"volume_error_worst_label", nullptr},
           {"labels_measured", volumes.labels_measured}};
  if (!volumes.worst) return out;
  out["volume_error_mean_abs"] = volumes.error_mean_abs;
  out["volume_error_max_abs"] = volumes.error_max_abs;
  out["volume_error_worst_label"] = label_json(table.raw(volumes.worst->label), table.is_signed());
  return out;
}

Json volume_row_json(const audit::VolumeRow& row, const io::LabelTable& table,
                     const io::LabelNames& names) {
  Json out = named_row_json(table.raw(row.label), table.is_signed(), names);
  out["voxels"] = row.voxels;
  out["volume_voxels"] = row.volume_voxels;
  out["volume_error"] = row.error;
  return out;
}

Json interfaces_json(const audit::ShapeReport& shape) {
  return {{"area", shape.area},
          {"bend_p50_deg", shape.bend_p50_deg},
          {"bend_p95_deg", shape.bend_p95_deg},
          {"bend_p99_deg", shape.bend_p99_deg},
          {"bend_max_deg", shape.bend_max_deg},
          {"sharp_share", shape.sharp_share}};
}

void print_volumes(const audit::VolumeReport& volumes, const io::LabelTable& table,
                   const io::LabelNames& names) {
  const audit::VolumeSummary& s = volumes.summary;
  std::cout << "volumes       ";
  if (!s.worst) {
    std::cout << "no label of " << audit::kMinJudgedVoxels << " voxels or more\n";
    return;
  }
  std::cout << "off by " << percent(s.error_max_abs, 2) << " at most (label "
            << label_text(table.raw(s.worst->label), table.is_signed(), names) << "), "
            << percent(s.error_mean_abs, 3) << " on average over " << s.labels_measured
            << " labels of " << audit::kMinJudgedVoxels << " voxels or more; "
            << (volumes.exact ? "exact" : "in floating point, vertices being off the lattice")
            << "\n";
}

void print_interfaces(const audit::ShapeReport& shape) {
  std::cout << "interfaces    area " << format_figure(shape.area) << "; edges bend by "
            << format_fixed(shape.bend_p50_deg, 1) << " degrees (median), "
            << format_fixed(shape.bend_p95_deg, 1) << " (95 %), "
            << format_fixed(shape.bend_max_deg, 1) << " (most); " << percent(shape.sharp_share, 2)
            << " of their length by more than " << engine::format_number(audit::kSharpDegrees)
            << "\n";
}

}  // namespace mw::report
