// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facts of meshes, labels and volumes as JSON.
#include "engine/report/mesh_facts.h"

#include <cmath>

#include "engine/report/figures.h"

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
          {"edge_median", quality.edge_median},
          {"height_min", quality.height_min}};
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

io::Json specks_json(const std::optional<io::SpeckFacts>& specks) {
  if (!specks) return nullptr;
  return {
      {"components", specks->components}, {"voxels", specks->voxels}, {"rounds", specks->rounds}};
}

io::Json slices_json(const std::optional<io::SliceFacts>& slices) {
  if (!slices) return nullptr;
  return {{"axis", std::string(1, "xyz"[slices->axis])},
          {"slices", slices->slices},
          {"layers", slices->layers}};
}

io::Json welds_json(const std::optional<io::WeldFacts>& welds) {
  if (!welds) return nullptr;
  return {
      {"voxels", welds->voxels}, {"rounds", welds->rounds}, {"labels_to_join", welds->has_solid}};
}

std::string steps_text(const Json& facts) {
  const Json& welds = facts["welds"];
  std::string out = told(
      "specks      {specks.components} components of {specks.voxels} voxels took the labels "
      "around them, in {specks.rounds} rounds\n",
      facts);
  out += told(
      "interpolated {interpolated.slices} slices along {interpolated.axis} became "
      "{interpolated.layers} thin ones each\n",
      facts);
  if (!welds.is_null() && !welds["labels_to_join"].boolean()) {
    return out +
           "welded      nothing: --weld names all labels of the volume, and joins the others\n";
  }
  return out + told("welded      {voxels} voxels were filled, in {rounds} rounds\n", welds);
}

}  // namespace mw::report
