// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Wording of distances.
#include "engine/report/distance_facts.h"

#include <cmath>
#include <iostream>

#include "engine/report/figures.h"
#include "engine/report/mesh_facts.h"
#include "engine/report/name_facts.h"

namespace mw::report {

using io::Json;

namespace {

Json finite_json(double voxels) {
  if (std::isfinite(voxels)) return voxels;
  return nullptr;
}

/// {"label": 3}, and its name if it has one.
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

/// "infinite for 2 labels with an interface on one side only (the first: 7)"; empty when all is
/// finite.
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

}  // namespace mw::report
