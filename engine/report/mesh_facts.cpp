// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Wording of quality, names, volumes, areas, bends and distances.
#include "engine/report/mesh_facts.h"

#include <cmath>
#include <iostream>

#include "engine/report/figures.h"
#include "engine/settings/number_text.h"

namespace mw::report {

using io::Json;

void append_with_rows(const Json& value, const std::function<void(const TakeRow&)>& for_each_row,
                      const AppendText& append) {
  const std::string text = value.dump_indented();
  // Inside of a string the quotes would be escaped, so this is the key and no part of a value.
  const std::string key = "\"per_label\": ";
  const std::string rows = "\"" + std::string(kRows) + "\"";
  const std::size_t at = text.find(key + rows) + key.size();
  append(std::string_view(text).substr(0, at));
  append("[");
  const char* before = "";
  for_each_row([&](const Json& row) {
    append(std::string(before) + "\n      " + row.dump());
    before = ",";
  });
  append("\n    ]");
  append(std::string_view(text).substr(at + rows.size()));
  append("\n");
}

using io::Json;

Json quality_json(const audit::QualityReport& quality) {
  return {{"radius_ratio_min", quality.radius_ratio_min},
          {"radius_ratio_mean", quality.radius_ratio_mean},
          {"radius_ratio_histogram", quality.radius_ratio_histogram},
          {"dihedral_histogram", quality.dihedral_histogram},
          {"sliver_fraction", quality.sliver_fraction},
          {"dihedral_min_deg", quality.dihedral_min_deg},
          {"dihedral_max_deg", quality.dihedral_max_deg},
          {"edge_min", quality.edge_min},
          {"edge_max", quality.edge_max},
          {"height_min", quality.height_min}};
}

void print_quality(const audit::QualityReport& quality) {
  std::cout << "radius ratio  " << format_fixed(quality.radius_ratio_min, 4) << " least, "
            << format_fixed(quality.radius_ratio_mean, 4) << " mean, "
            << format_fixed(100 * quality.sliver_fraction, 3) << " % of tets below 0.1\n"
            << "dihedral      " << format_fixed(quality.dihedral_min_deg, 2) << " to "
            << format_fixed(quality.dihedral_max_deg, 2) << " degrees\n"
            << "edges         " << format_figure(quality.edge_min) << " to "
            << format_figure(quality.edge_max) << " long; the least height of a tet is "
            << format_figure(quality.height_min) << "\n";
}

Json label_json(RawLabel label, bool is_signed) {
  if (is_signed) return static_cast<std::int64_t>(label);
  return label;
}

Json betti_json(const audit::Betti& betti) {
  return {betti.b0, betti.b1, betti.b2};
}

Json index_json(Index3 at) {
  return {at.x, at.y, at.z};
}

void write_json(io::AtomicFile& file, const Json& value) {
  file.append(value.dump_indented());
  file.append("\n");
  file.commit();
}

using io::Json;

std::string label_text(RawLabel label, bool is_signed, const io::LabelNames& names) {
  const std::string& name = names.name(label);
  return io::label_text(label, is_signed) + (name.empty() ? "" : " \"" + name + "\"");
}

audit::LabelText label_texts(const io::LabelTable& table, io::LabelNames names) {
  return [&table, names = std::move(names)](Label label) {
    return "label " + label_text(table.raw(label), table.is_signed(), names);
  };
}

Json named_row_json(RawLabel label, bool is_signed, const io::LabelNames& names) {
  Json row{{"label", label_json(label, is_signed)}};
  const std::string& name = names.name(label);
  if (!name.empty()) row["name"] = name;
  return row;
}

void add_colour(Json& row, RawLabel label, const io::LabelNames& names) {
  const io::LabelName* found = names.find(label);
  if (found != nullptr && found->colour) row["colour"] = *found->colour;
}

using io::Json;

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
  std::cout << "off by " << format_percent(s.error_max_abs, 2) << " at most (label "
            << label_text(table.raw(s.worst->label), table.is_signed(), names) << "), "
            << format_percent(s.error_mean_abs, 3) << " on average over " << s.labels_measured
            << " labels of " << audit::kMinJudgedVoxels << " voxels or more; "
            << (volumes.exact ? "exact" : "in floating point, vertices being off the lattice")
            << "\n";
}

void print_interfaces(const audit::ShapeReport& shape) {
  std::cout << "interfaces    area " << format_figure(shape.area) << "; edges bend by "
            << format_fixed(shape.bend_p50_deg, 1) << " degrees (median), "
            << format_fixed(shape.bend_p95_deg, 1) << " (95 %), "
            << format_fixed(shape.bend_max_deg, 1) << " (most); "
            << format_percent(shape.sharp_share, 2) << " of their length by more than "
            << engine::format_number(audit::kSharpDegrees) << "\n";
}

using io::Json;

namespace {

Json finite_json(double voxels) {
  if (std::isfinite(voxels)) return voxels;
  return nullptr;
}

/// Returns {"label": 3}, with its name if it has one.
Json label_row(Label label, const io::LabelTable& table, const io::LabelNames& names) {
  if (label == audit::kUnknown) return {{"label", nullptr}};
  if (label == audit::kLeftOut) return {{"label", "left out"}};
  return named_row_json(table.raw(label), table.is_signed(), names);
}

std::string name_text(Label label, const io::LabelTable& table, const io::LabelNames& names) {
  if (label == audit::kUnknown) return "one that the volume does not have";
  if (label == audit::kLeftOut) return "left out";
  return label_text(table.raw(label), table.is_signed(), names);
}

/// Returns "infinite for 2 labels with an interface on one side only (the first: 7)", or nothing
/// when all is finite.
std::string infinite_text(const audit::DistanceReport& distance, const io::LabelTable& table,
                          const io::LabelNames& names) {
  const std::size_t count = distance.only_in_volume.size() + distance.only_in_mesh.size();
  if (count == 0) return "";
  const Label first = distance.only_in_volume.empty() ? distance.only_in_mesh.front()
                                                      : distance.only_in_volume.front();
  return "infinite for " + std::to_string(count) + (count == 1 ? " label" : " labels") +
         " with an interface on one side only (the first: " + name_text(first, table, names) + ")";
}

std::string finite_text(const audit::DistanceReport& distance, const io::LabelTable& table,
                        const io::LabelNames& names) {
  const auto* farthest = distance.farthest();
  if (farthest == nullptr) return "";
  std::string text = format_fixed(farthest->max(), 2) + " voxels at most (label " +
                     name_text(farthest->label, table, names) + ")";
  if (!distance.is_finite()) return text + " for the others";
  return text + ", " + format_fixed(distance.mean_voxels, 2) + " on average";
}

}  // namespace

Json distance_json(const audit::DistanceReport& distance, const io::LabelTable& table,
                   const io::LabelNames& names) {
  Json labels = Json::array();
  for (const auto& row : distance.per_label) {
    Json out = label_row(row.label, table, names);
    out["input_to_mesh_max"] = finite_json(row.input_to_mesh_max);
    out["input_to_mesh_mean"] = finite_json(row.input_to_mesh_mean);
    out["mesh_to_input_max"] = finite_json(row.mesh_to_input_max);
    out["mesh_to_input_mean"] = finite_json(row.mesh_to_input_mean);
    labels.push_back(std::move(out));
  }
  return {{"max_voxels", finite_json(distance.max_voxels)},
          {"mean_voxels", finite_json(distance.mean_voxels)},
          {"covering_radius", audit::kCoveringRadius},
          {"covered_above", distance.limit},
          {"far_samples", distance.far_samples},
          {"per_label", std::move(labels)}};
}

void print_distance(const audit::DistanceReport& distance, const io::LabelTable& table,
                    const io::LabelNames& names) {
  const std::string infinite = infinite_text(distance, table, names);
  const std::string finite = finite_text(distance, table, names);
  std::cout << "distance      " << infinite << (infinite.empty() || finite.empty() ? "" : "; ")
            << finite;
  if (distance.per_label.empty()) std::cout << "no interface to measure";
  if (!finite.empty()) std::cout << "; " << audit::sampling_text(distance);
  std::cout << "\n";
}

io::Json specks_json(const std::optional<io::SpeckFacts>& specks) {
  if (!specks) return nullptr;
  return {
      {"components", specks->components}, {"voxels", specks->voxels}, {"rounds", specks->rounds}};
}

void print_specks(const std::optional<io::SpeckFacts>& specks) {
  if (!specks) return;
  std::cout << "specks      " << specks->components << " components of " << specks->voxels
            << " voxels took the labels around them, in " << specks->rounds << " rounds\n";
}

io::Json welds_json(const std::optional<io::WeldFacts>& welds) {
  if (!welds) return nullptr;
  return {{"voxels", welds->voxels}, {"rounds", welds->rounds}};
}

void print_welds(const std::optional<io::WeldFacts>& welds) {
  if (!welds) return;
  if (!welds->has_solid) {
    std::cout
        << "welded      nothing: --weld names all labels of the volume, and joins the others\n";
    return;
  }
  std::cout << "welded      " << welds->voxels << " voxels were filled, in " << welds->rounds
            << " rounds\n";
}

}  // namespace mw::report
