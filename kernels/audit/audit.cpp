// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// All checks together and their wording.
#include "kernels/audit/audit.h"

#include <algorithm>
#include <string>

namespace mw::audit {
namespace {

std::string text_of(const Betti& b) {
  return "(" + std::to_string(b.b0) + "," + std::to_string(b.b1) + "," + std::to_string(b.b2) + ")";
}

std::string change_text(const char* region, const Betti& before, const Betti& after) {
  if (before == after) return "";
  return std::string(" ") + region + " " + text_of(before) + " -> " + text_of(after);
}

std::string label_text(Label label) {
  if (label == kExterior) return "exterior";
  return label == kUnknown ? "unknown" : "dense " + std::to_string(label);
}

Check compare_topology(AuditReport& report) {
  const std::size_t exterior = report.voxels.size() - 1;
  Offenders changed("labels changed");
  for (std::size_t row = 0; row <= exterior; ++row) {
    const RegionBetti& before = report.voxels[row];
    const RegionBetti& after = report.mesh[row];
    if (before == after) continue;
    const Label label = row == exterior ? kExterior : static_cast<Label>(row);
    report.labels_changed.push_back(label);
    changed.add([&] {
      return label_text(label) + change_text("closed", before.closed, after.closed) +
             change_text("open", before.open, after.open);
    });
  }
  std::string detail = changed.text() + " of " + std::to_string(exterior + 1);
  if (report.topology_is_indicative) detail += "; only indicative, as P2 fails";
  return {"P1 topology", changed.count() == 0, detail};
}

Check judge_quality(const QualityReport& quality, double floor) {
  const std::string detail = "least " + number(quality.radius_ratio_min) + " (tet " +
                             std::to_string(quality.worst_tet) + "), mean " +
                             number(quality.radius_ratio_mean) + ", floor " + number(floor);
  return {"P3 radius ratio", quality.radius_ratio_min >= floor, detail};
}

std::string distance_text(const DistanceReport& distance) {
  const DistanceReport::PerLabel* farthest = distance.farthest();
  if (farthest == nullptr) return "no interface on both sides";
  return number(farthest->max()) + " voxels at most (" + label_text(farthest->label) + ")" +
         (distance.is_finite() ? ", mean " + number(distance.mean_voxels) : "");
}

/// Sampled distances fail only when they exceed the bound by more than rounding.
Check judge_distance(const DistanceReport& distance, const std::optional<double>& bound) {
  constexpr double kRounding = 1e-6;
  std::string detail = distance_text(distance);
  if (bound) detail += ", bound " + number(*bound);
  detail += "; " + sampling_text(distance);
  const auto name_labels = [&](const char* noun, const std::vector<Label>& labels) {
    Offenders lonely(noun);
    for (const Label label : labels) lonely.add([&] { return label_text(label); });
    if (lonely.count() > 0) detail += "; " + lonely.text();
  };
  name_labels("labels without an interface in the mesh", distance.only_in_volume);
  name_labels("labels without an interface in the volume", distance.only_in_mesh);
  const bool passed = distance.is_finite() && (!bound || distance.max_voxels <= *bound + kRounding);
  return {"P4 distance", passed, detail};
}

}  // namespace

bool AuditReport::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const Check& c) { return c.passed; });
}

AuditReport audit(const VoxelLabels& volume, std::size_t label_count, const AuditMesh& mesh,
                  const Frame& frame, const AuditOptions& options) {
  AuditReport report;
  report.voxels = voxel_betti(volume, label_count);
  report.validity = check_validity(mesh, volume, frame, label_count);
  report.checks = report.validity.checks;
  report.topology_is_indicative = !report.validity.passed();
  if (!report.checks.front().passed) {
    report.checks.push_back({"P1 topology", false, "not looked at: the input is no mesh"});
    report.checks.push_back({"P3 radius ratio", false, "not looked at: the input is no mesh"});
    if (options.max_distance) {
      report.checks.push_back({"P4 distance", false, "not looked at: the input is no mesh"});
    }
    return report;
  }
  report.mesh = mesh_betti(mesh, label_count);
  report.checks.push_back(compare_topology(report));
  report.quality = measure_quality(mesh);
  report.checks.push_back(judge_quality(report.quality, options.radius_ratio_floor));
  if (options.measure_distance || options.max_distance) {
    report.distance = measure_distance(volume, label_count, mesh, frame);
    if (options.max_distance || !report.distance->is_finite()) {
      report.checks.push_back(judge_distance(*report.distance, options.max_distance));
    }
  }
  return report;
}

}  // namespace mw::audit
