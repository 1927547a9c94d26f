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

/// Says what distances count in, where that is not the input's voxels.
void print_lattice(Index3 layers) {
  if (layers == Index3{1, 1, 1}) return;
  std::cout << "lattice       distances are in voxels cut into " << layers.x << " x " << layers.y
            << " x " << layers.z << " layers\n";
}

std::string changed_text(Label label, const Verdict& verdict) {
  if (label == kExterior) return "exterior";
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

Json topology_json(const Verdict& verdict) {
  if (!verdict.looked_at()) return {{"checked", false}, {"labels_changed", nullptr}};
  Json out{{"checked", true},
           {"labels_changed", verdict.audit.labels_changed.size()},
           {"changed", changed_labels(verdict)},
           {"indicative_only", verdict.audit.topology_is_indicative}};
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
  print_specks(verdict.specks);
  print_welds(verdict.welds);
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
      std::cout << " " << changed_text(label, verdict);
    }
    std::cout << "\n";
  }
  if (verdict.looked_at()) {
    print_quality(verdict.audit.quality);
    print_volumes(verdict.audit.volumes, verdict.table, verdict.names);
    print_interfaces(verdict.audit.shape);
  }
  if (verdict.audit.distance) {
    print_lattice(verdict.layers);
    print_distance(*verdict.audit.distance, verdict.table, verdict.names);
  }
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
