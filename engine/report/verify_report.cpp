// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh verify` found, in words and as JSON.
#include "engine/report/verify_report.h"

#include "engine/version.h"

#include <algorithm>
#include <iostream>

#include "engine/report/figures.h"
#include "engine/report/mesh_facts.h"
#include "engine/settings/number_text.h"
#include "io/file/errors.h"

namespace mw::report {
namespace {

using io::Json;

constexpr const char* kNone = "none";
constexpr const char* kInterfaces = "interfaces";
constexpr const char* kVoxel = "voxel";

/// Returns the changed labels by the numbers of the input; the outside is "exterior".
std::vector<std::string> changed_labels(const Verdict& verdict) {
  std::vector<std::string> out;
  const io::LabelTable& table = verdict.table;
  for (const Label label : verdict.audit.labels_changed) {
    out.push_back(label == kExterior ? "exterior"
                                     : io::label_text(table.raw(label), table.is_signed()));
  }
  return out;
}

std::string name_text(Label label, const Verdict& verdict) {
  if (label == kExterior) return "exterior";
  if (label == audit::kUnknown) return "one that the volume does not have";
  if (label == audit::kLeftOut) return "left out";
  return label_text(verdict.table.raw(label), verdict.table.is_signed(), verdict.names);
}

/// Says whether the bounds are a recorded promise, and what they leave out.
std::string told_text(const Bounds& bounds) {
  return (bounds.of_run ? "recorded promise: " : "no recorded promise: ") + bounds.told;
}

void print_bounds(const Bounds& bounds) {
  const io::MeshPromises& asked = bounds.promises;
  std::cout << "asked         distance "
            << (asked.max_distance ? engine::format_number(*asked.max_distance) : kNone)
            << ", radius ratio " << engine::format_number(asked.quality_floor) << ", topology "
            << (asked.interfaces ? kInterfaces : "labels") << ", volumes "
            << (bounds.max_volume_error ? engine::format_number(*bounds.max_volume_error) : kNone)
            << (bounds.of_run ? " (what is not given is what the run promised)\n" : "\n");
}

Json pinches_json(const audit::Pinches& pinches) {
  return {{"edges", pinches.edges}, {"vertices", pinches.vertices}};
}

Json topology_json(const Verdict& verdict) {
  if (!verdict.looked_at()) return {{"checked", false}, {"labels_changed", nullptr}};
  Json out{{"checked", true},
           {"labels_changed", verdict.audit.labels_changed.size()},
           {"changed", changed_labels(verdict)},
           {"indicative_only", verdict.audit.topology_is_indicative},
           {"pinches",
            {{"volume", pinches_json(verdict.audit.pinches.voxels)},
             {"mesh", pinches_json(verdict.audit.pinches.mesh)}}}};
  if (const auto& junctions = verdict.audit.junctions) {
    out["interfaces"] = junctions->interfaces;
    out["interfaces_changed"] = junctions->interfaces_changed.size();
    out["meetings"] = junctions->meetings;
    out["meetings_changed"] = junctions->meetings_changed.size();
  }
  return out;
}

Json measured_distance(const Verdict& verdict) {
  if (!verdict.audit.distance) return nullptr;
  return distance_json(*verdict.audit.distance, verdict.table, verdict.names);
}

Json volume_json(const Verdict& verdict) {
  if (!verdict.looked_at()) return nullptr;
  const audit::VolumeReport& volumes = verdict.audit.volumes;
  Json out = volume_summary_json(volumes.summary, verdict.table);
  out["exact"] = volumes.exact;
  Json rows = Json::array();
  for (const audit::VolumeRow& row : volumes.per_label) {
    Json out_row = volume_row_json(row, verdict.table, verdict.names);
    add_topology(row.label, verdict.audit, out_row);
    rows.push_back(std::move(out_row));
  }
  out["per_label"] = std::move(rows);
  return out;
}

Json region_json(const audit::RegionBetti& betti) {
  return {{"closed", betti_json(betti.closed)}, {"open", betti_json(betti.open)}};
}

bool is_in_box(const std::vector<audit::Check>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const audit::Check& check) {
    return check.passed || check.name != "P2 box";
  });
}

std::string volumes_text(const Verdict& verdict, const Json& volume) {
  const audit::VolumeReport& volumes = verdict.audit.volumes;
  const std::string large = io::text(" of ", audit::kMinJudgedVoxels, " voxels or more");
  if (!volumes.summary.worst) return "no label" + large;
  return told("off by {volume_error_max_abs:2%} at most (label ", volume) +
         name_text(volumes.summary.worst->label, verdict) +
         told("), {volume_error_mean_abs:3%} on average over {labels_measured} labels", volume) +
         large +
         (volumes.exact ? "; exact" : "; in floating point, vertices being off the lattice");
}

/// Prints what the mesh is like, whether or not the checks hold.
void print_measured(const Verdict& verdict, const Json& facts) {
  std::cout << told(
                   "radius ratio  {radius_ratio_min:4} least, {radius_ratio_mean:4} mean, "
                   "{sliver_fraction:3%} of tets below 0.1\n"
                   "dihedral      {dihedral_min_deg:2} to {dihedral_max_deg:2} degrees\n"
                   "edges         {edge_min:g} to {edge_max:g} long; the least height of a tet is "
                   "{height_min:g}\n",
                   facts["quality"])
            << "volumes       " << volumes_text(verdict, facts["volume"]) << "\n"
            << told(
                   "interfaces    area {area:g}; edges bend by {bend_p50_deg:1} degrees (median), "
                   "{bend_p95_deg:1} (95 %), "
                   "{bend_max_deg:1} (most); {sharp_share:2%} of their length by more than ",
                   facts["shape"])
            << engine::format_number(audit::kSharpDegrees) << "\n";
}

/// Returns "infinite for 2 labels with an interface on one side only (the first: 7)", or nothing
/// when all is finite.
std::string infinite_text(const audit::DistanceReport& distance, const Verdict& verdict) {
  const std::size_t count = distance.only_in_volume.size() + distance.only_in_mesh.size();
  if (count == 0) return "";
  const Label first = distance.only_in_volume.empty() ? distance.only_in_mesh.front()
                                                      : distance.only_in_volume.front();
  return io::text("infinite for ", count, count == 1 ? " label" : " labels",
                  " with an interface on one side only (the first: ", name_text(first, verdict),
                  ")");
}

std::string finite_text(const audit::DistanceReport& distance, const Verdict& verdict) {
  const auto* farthest = distance.farthest();
  if (farthest == nullptr) return "";
  const std::string text = format_fixed(farthest->max(), 2) + " voxels at most (label " +
                           name_text(farthest->label, verdict) + ")";
  if (!distance.is_finite()) return text + " for the others";
  return text + ", " + format_fixed(distance.mean_voxels, 2) + " on average";
}

/// Says how far boundaries moved, and what distances count in, where that is not the input's
/// voxels.
void print_distance(const audit::DistanceReport& distance, const Verdict& verdict,
                    const Json& facts) {
  const std::string infinite = infinite_text(distance, verdict);
  const std::string finite = finite_text(distance, verdict);
  if (verdict.layers != Index3{1, 1, 1}) {
    std::cout << told(
        "lattice       distances are in voxels cut into {lattice.layers_xyz} layers\n", facts);
  }
  std::cout << "distance      " << infinite << (infinite.empty() || finite.empty() ? "" : "; ")
            << finite;
  if (distance.per_label.empty()) std::cout << "no interface to measure";
  if (!finite.empty()) std::cout << "; " << audit::sampling_text(distance);
  std::cout << "\n";
}

Json asked_json(const Bounds& bounds) {
  const io::MeshPromises& asked = bounds.promises;
  return {{"max_distance", asked.max_distance ? Json(*asked.max_distance) : Json()},
          {"quality_floor", asked.quality_floor},
          {"topology", asked.interfaces ? kInterfaces : "labels"},
          {"surface", asked.smooth ? "smooth" : kVoxel},
          {"max_volume_error", bounds.max_volume_error ? Json(*bounds.max_volume_error) : Json()},
          {"of_run", bounds.of_run},
          {"less_than_default", bounds.told}};
}

}  // namespace

void print_verdict(const Verdict& verdict) {
  const auto& checks = verdict.audit.checks;
  if (!verdict.bounds.told.empty()) std::cout << told_text(verdict.bounds) << "\n";
  const Json facts = verdict_json(verdict);
  std::cout << steps_text(facts);
  print_bounds(verdict.bounds);
  for (const audit::Check& check : checks) {
    std::string name = check.name;
    name.resize(std::max<std::size_t>(name.size(), 16), ' ');
    std::cout << (check.passed ? "ok    " : "FAIL  ") << name << " " << check.detail << "\n";
  }
  if (!is_in_box(checks)) {
    std::cout << "the mesh is not in the box of this volume: give verify the --spacing, --origin, "
                 "--frame and --crop of the run that made it\n";
  }
  if (!verdict.audit.labels_changed.empty()) {
    std::cout << "labels whose topology changed:";
    for (const Label label : verdict.audit.labels_changed) {
      std::cout << " " << name_text(label, verdict);
    }
    std::cout << "\n";
  }
  if (verdict.looked_at()) print_measured(verdict, facts);
  if (verdict.audit.distance) print_distance(*verdict.audit.distance, verdict, facts);
  const auto failed = std::count_if(checks.begin(), checks.end(),
                                    [](const audit::Check& check) { return !check.passed; });
  std::cout << (failed == 0 ? "all checks hold" : std::to_string(failed) + " checks fail")
            << (verdict.bounds.told.empty() ? "" : "; " + told_text(verdict.bounds)) << "\n";
}

Json checks_json(const audit::AuditReport& audit) {
  Json out = Json::array();
  for (const audit::Check& check : audit.checks) {
    out.push_back({{"name", check.name}, {"passed", check.passed}, {"detail", check.detail}});
  }
  return out;
}

void add_topology(Label label, const audit::AuditReport& report, Json& row) {
  row["betti_of_volume"] = region_json(report.voxels[label]);
  row["betti_of_mesh"] = region_json(report.mesh[label]);
}

Json verdict_json(const Verdict& verdict) {
  const bool measured = verdict.looked_at();
  return {{"asked", asked_json(verdict.bounds)},
          {"labels", verdict.table.size()},
          {"specks", specks_json(verdict.specks)},
          {"interpolated", slices_json(verdict.slices)},
          {"welds", welds_json(verdict.welds)},
          {"lattice", {{"layers_xyz", {verdict.layers.x, verdict.layers.y, verdict.layers.z}}}},
          {"passed", verdict.audit.passed()},
          {"checks", checks_json(verdict.audit)},
          {"quality", measured ? quality_json(verdict.audit.quality) : Json(nullptr)},
          {"volume", volume_json(verdict)},
          {"shape", measured ? interfaces_json(verdict.audit.shape) : Json(nullptr)},
          {"distance", measured_distance(verdict)},
          {"topology", topology_json(verdict)}};
}

Json verify_report(const Json& settings, const Verdict& verdict,
                   const engine::Resources& resources) {
  Json out{{"version", engine::version()}, {"settings", settings}};
  out.update(verdict_json(verdict));
  out["performance"] = {{"wall_s", resources.wall_seconds},
                        {"cpu_s", resources.cpu_seconds},
                        {"peak_rss_bytes", resources.peak_rss_bytes}};
  return out;
}

}  // namespace mw::report
