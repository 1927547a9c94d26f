// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Wording of distances.
#include "engine/cli/distance_facts.h"

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "engine/cli/mesh_facts.h"
#include "engine/cli/values.h"

namespace mw::cli {

using nlohmann::ordered_json;

namespace {

ordered_json finite_json(double voxels) {
  if (std::isfinite(voxels)) return voxels;
  return nullptr;
}

ordered_json name_json(Label label, const io::LabelTable& table) {
  if (label == audit::kUnknown) return nullptr;
  if (label == audit::kLeftOut) return "left out";
  return label_json(table.raw(label), table.is_signed());
}

std::string name_text(Label label, const io::LabelTable& table) {
  if (label == audit::kUnknown) return "one that the volume does not have";
  if (label == audit::kLeftOut) return "left out";
  return format_label(table.raw(label), table.is_signed());
}

/// "infinite for 2 labels with an interface on one side only (the first: 7)"; empty when all is
/// finite.
std::string infinite_text(const audit::DistanceReport& distance, const io::LabelTable& table) {
  const std::size_t count = distance.only_in_volume.size() + distance.only_in_mesh.size();
  if (count == 0) return "";
  const Label first = distance.only_in_volume.empty() ? distance.only_in_mesh.front()
                                                      : distance.only_in_volume.front();
  return "infinite for " + std::to_string(count) + (count == 1 ? " label" : " labels") +
         " with an interface on one side only (the first: " + name_text(first, table) + ")";
}

std::string finite_text(const audit::DistanceReport& distance, const io::LabelTable& table) {
  const auto* farthest = distance.farthest();
  if (farthest == nullptr) return "";
  std::string text = format_fixed(farthest->max(), 2) + " voxels at most (label " +
                     name_text(farthest->label, table) + ")";
  if (!distance.is_finite()) return text + " for the others";
  return text + ", " + format_fixed(distance.mean_voxels, 2) + " on average";
}

}  // namespace

ordered_json distance_json(const audit::DistanceReport& distance, const io::LabelTable& table) {
  ordered_json labels = ordered_json::array();
  for (const auto& row : distance.per_label) {
    labels.push_back({{"label", name_json(row.label, table)},
                      {"input_to_mesh_max", finite_json(row.input_to_mesh_max)},
                      {"input_to_mesh_mean", finite_json(row.input_to_mesh_mean)},
                      {"mesh_to_input_max", finite_json(row.mesh_to_input_max)},
                      {"mesh_to_input_mean", finite_json(row.mesh_to_input_mean)}});
  }
  return {{"max_voxels", finite_json(distance.max_voxels)},
          {"mean_voxels", finite_json(distance.mean_voxels)},
          {"samples_a_face", distance.samples_a_face},
          {"input_covering_radius", distance.input_covering_radius},
          {"mesh_covering_radius", distance.mesh_covering_radius},
          {"per_label", std::move(labels)}};
}

void print_distance(const audit::DistanceReport& distance, const io::LabelTable& table) {
  const std::string infinite = infinite_text(distance, table);
  const std::string finite = finite_text(distance, table);
  std::cout << "distance      " << infinite << (infinite.empty() || finite.empty() ? "" : "; ")
            << finite;
  if (distance.per_label.empty()) std::cout << "no interface to measure";
  if (!finite.empty()) std::cout << "; " << audit::sampling_text(distance);
  std::cout << "\n";
}

}  // namespace mw::cli
