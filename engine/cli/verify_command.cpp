// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh verify: promises P1 to P4 and P8 of a finished mesh, independently of how it was made.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "engine/cli/commands.h"
#include "engine/cli/distance_facts.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/label_choice.h"
#include "engine/cli/mesh_facts.h"
#include "engine/cli/name_facts.h"
#include "engine/cli/resource_meter.h"
#include "engine/cli/shape_facts.h"
#include "engine/cli/speck_facts.h"
#include "engine/cli/values.h"
#include "engine/cli/volume_options.h"
#include "engine/label_scan.h"
#include "engine/reading_tiles.h"
#include "io/mesh/array_axes.h"
#include "io/mesh/open_mesh.h"
#include "kernels/audit/audit.h"
#include "kernels/audit/kept_orientation.h"
#include "kernels/core/each_index.h"
#include "kernels/core/error.h"
#include "kernels/core/layers.h"

namespace mw::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kNone = "none";
constexpr const char* kInterfaces = "interfaces";
constexpr const char* kVoxel = "voxel";

struct VerifyJob {
  OptionSet options;
  VolumeRequest volume;
  LabelChoice choice;
  std::filesystem::path mesh;
  std::filesystem::path report;
  audit::AuditOptions audit;
  bool in_layers = true;  ///< distances in voxels of the lattice of smooth surfaces
};

struct Verdict {
  std::optional<io::SpeckFacts> specks;
  audit::AuditReport audit;
  std::vector<std::string> labels_changed;  ///< as the input has them, or "exterior"
  io::LabelTable table;
  io::LabelNames names;
  Index3 layers;

  /// The first check asks whether the file holds a mesh at all.
  [[nodiscard]] bool looked_at() const { return audit.checks.front().passed; }
};

std::optional<double> parse_bound(const std::string& text) {
  if (text == kNone) return std::nullopt;
  const double bound = parse_number(text);
  if (bound >= 0) return bound;
  throw Error(ErrorKind::kUsage, "must not be negative; or none");
}

void add_verify_options(VerifyJob& job) {
  OptionSet& options = job.options;
  add_input_option(options, job.volume.path);
  options.add({.name = "mesh",
               .value = "MESH",
               .help = "mesh to check: " + io::mesh_extensions(),
               .flags = "MESH,--mesh",
               .assign = [&](const std::string& text) { job.mesh = text; }});
  add_volume_options(options, job.volume);
  add_choice_options(options, job.choice);
  options.add(
      {.name = "topology",
       .value = "WHAT",
       .help = "what P1 looks at: labels, or interfaces and meetings of labels as well",
       .fallback = "labels",
       .choices = {"labels", kInterfaces},
       .assign = [&](const std::string& text) { job.audit.count_places = text == kInterfaces; }});
  options.add({.name = "quality-floor",
               .value = "R",
               .help = "P3 fails for a tet below this radius ratio",
               .kind = ValueKind::kNumber,
               .fallback = format_number(audit::AuditOptions{}.radius_ratio_floor),
               .assign = [&](const std::string& text) {
                 job.audit.radius_ratio_floor = parse_number(text);
               }});
  options.add(
      {.name = "max-distance",
       .value = "D",
       .help = "P4 fails above this many voxels (see --surface) between label boundaries, or none",
       .kind = ValueKind::kNumberOrNone,
       .fallback = kNone,
       .assign = [&](const std::string& text) { job.audit.max_distance = parse_bound(text); }});
  options.add({.name = "surface",
               .value = "SHAPE",
               .help = "how the mesh was made, hence what distances count in: smooth, voxels of "
                       "the lattice where thick slices are cut into layers; voxel, the input's",
               .fallback = "smooth",
               .choices = {"smooth", kVoxel},
               .assign = [&](const std::string& text) { job.in_layers = text != kVoxel; }});
  options.add(
      {.name = "max-volume-error",
       .value = "E",
       .help = "P8 fails when a label of 1000 voxels or more is off by a larger share of its "
               "volume, or none",
       .kind = ValueKind::kNumberOrNone,
       .fallback = format_number(*audit::AuditOptions{}.max_volume_error),
       .assign = [&](const std::string& text) { job.audit.max_volume_error = parse_bound(text); }});
  options.add({.name = "report",
               .value = "FILE.json",
               .help = "writes the result as JSON",
               .assign = [&](const std::string& text) { job.report = text; }});
}

std::vector<std::string> changed_labels(const audit::AuditReport& audit,
                                        const io::LabelTable& table) {
  std::vector<std::string> out;
  for (const Label label : audit.labels_changed) {
    out.push_back(label == kExterior ? "exterior"
                                     : format_label(table.raw(label), table.is_signed()));
  }
  return out;
}

/// Empty when all are.
audit::KeptLabels kept_labels(const LabelChoice& choice, const io::LabelTable& table) {
  const engine::WantedLabel wanted = wanted_labels(choice, table);
  audit::KeptLabels kept;
  for (Label label = 0; wanted && label < table.size(); ++label) {
    kept.push_back(wanted(table.raw(label)));
  }
  const bool leaves_out = std::find(kept.begin(), kept.end(), false) != kept.end();
  return leaves_out ? kept : audit::KeptLabels{};
}

/// Audits in the array's axes a mesh that lies in another direction, and that the file's
/// coordinates are as positive as those.
audit::AuditReport audit_turned(const audit::VoxelLabels& subject, std::size_t label_count,
                                io::MeshData mesh, std::span<const Label> labels,
                                const io::VolumeSpace& space, const audit::AuditOptions& options) {
  const std::vector<io::Position> written = mesh.vertices;
  turn_to_array(mesh, space, layers_of(space.spacing));
  const audit::AuditMesh turned = audit_view(mesh, labels);
  audit::AuditReport report =
      audit::audit(subject, label_count, turned, {.spacing = space.spacing, .origin = {}}, options);
  if (report.checks.front().passed) {
    report.checks.push_back(audit::check_kept_orientation(turned, written, is_mirrored(space)));
  }
  return report;
}

/// All voxels, tile by tile, so that no chunk of a store is unpacked twice.
std::vector<Label> read_all(const io::DenseVolume& volume) {
  const Box3 all{{0, 0, 0}, volume.info().shape};
  std::vector<Label> out(static_cast<std::size_t>(all.voxels()));
  const engine::ReadingTiles tiles(volume.info());
  std::vector<Label> tile;
  each_index(tiles.count(), [&](Index3 t) {
    const Box3 box = tiles.box(t);
    tile.resize(static_cast<std::size_t>(box.voxels()));
    volume.read(box, tile);
    auto row = tile.begin();
    for (Index3 v = box.lo; v.z < box.hi.z; ++v.z) {
      for (v.y = box.lo.y; v.y < box.hi.y; ++v.y, row += box.shape().x) {
        std::copy_n(row, box.shape().x, out.begin() + all.offset(v));
      }
    }
  });
  return out;
}

Verdict judge(const VerifyJob& job) {
  const std::unique_ptr<io::LabelVolume> opened = open(job.volume);
  const io::PreparedInput input(*opened, job.volume.steps);
  const io::LabelVolume& volume = input.volume();
  io::LabelTable table = engine::collect_labels(volume, 1);
  const io::VolumeInfo& info = volume.info();
  const std::vector<Label> voxels = read_all(io::DenseVolume(volume, table));
  volume.drop_buffers();
  io::MeshData mesh = io::read_mesh(job.mesh);
  const std::vector<Label> labels = dense_labels(mesh, table);
  Verdict verdict{.specks = input.specks()};
  audit::AuditOptions options = job.audit;
  options.kept = kept_labels(job.choice, table);
  if (job.in_layers) options.layers = layers_of(info.space.spacing);
  verdict.layers = options.layers;
  const audit::VoxelLabels subject{.shape = info.shape, .labels = voxels};
  if (is_upright(info.space)) {
    verdict.audit =
        audit::audit(subject, table.size(), audit_view(mesh, labels),
                     {.spacing = info.space.spacing, .origin = info.space.origin}, options);
  } else {
    verdict.audit =
        audit_turned(subject, table.size(), std::move(mesh), labels, info.space, options);
  }
  verdict.labels_changed = changed_labels(verdict.audit, table);
  verdict.table = std::move(table);
  verdict.names = info.names;
  return verdict;
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

void print_verdict(const Verdict& verdict) {
  const auto& checks = verdict.audit.checks;
  print_specks(verdict.specks);
  for (const audit::Check& check : checks) {
    std::string name = check.name;
    name.resize(std::max<std::size_t>(name.size(), 16), ' ');
    std::cout << (check.passed ? "ok    " : "FAIL  ") << name << " " << check.detail << "\n";
  }
  if (!verdict.labels_changed.empty()) {
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
  std::cout << (failed == 0 ? "all checks hold" : std::to_string(failed) + " checks fail") << "\n";
}

ordered_json checks_json(const audit::AuditReport& audit) {
  ordered_json out = ordered_json::array();
  for (const audit::Check& check : audit.checks) {
    out.push_back({{"name", check.name}, {"passed", check.passed}, {"detail", check.detail}});
  }
  return out;
}

ordered_json topology_json(const Verdict& verdict) {
  if (!verdict.looked_at()) return {{"checked", false}, {"labels_changed", nullptr}};
  ordered_json out{{"checked", true},
                   {"labels_changed", verdict.labels_changed.size()},
                   {"changed", verdict.labels_changed},
                   {"indicative_only", verdict.audit.topology_is_indicative}};
  if (const auto& places = verdict.audit.places) {
    out["interfaces"] = places->interfaces;
    out["interfaces_changed"] = places->interfaces_changed.size();
    out["meetings"] = places->meetings;
    out["meetings_changed"] = places->meetings_changed.size();
  }
  return out;
}

ordered_json measured_distance(const Verdict& verdict) {
  if (!verdict.audit.distance) return nullptr;
  return distance_json(*verdict.audit.distance, verdict.table, verdict.names);
}

ordered_json volume_json(const Verdict& verdict) {
  if (!verdict.looked_at()) return nullptr;
  const audit::VolumeReport& volumes = verdict.audit.volumes;
  ordered_json out = volume_summary_json(volumes.summary, verdict.table);
  out["exact"] = volumes.exact;
  ordered_json rows = ordered_json::array();
  for (const audit::VolumeRow& row : volumes.per_label) {
    rows.push_back(volume_row_json(row, verdict.table, verdict.names));
  }
  out["per_label"] = std::move(rows);
  return out;
}

ordered_json verify_report(const VerifyJob& job, const Verdict& verdict,
                           const Resources& resources) {
  const bool measured = verdict.looked_at();
  return {{"version", MW_VERSION},
          {"settings", job.options.json()},
          {"labels", verdict.table.size()},
          {"specks", specks_json(verdict.specks)},
          {"lattice", {{"layers_xyz", {verdict.layers.x, verdict.layers.y, verdict.layers.z}}}},
          {"passed", verdict.audit.passed()},
          {"checks", checks_json(verdict.audit)},
          {"quality", measured ? quality_json(verdict.audit.quality) : ordered_json(nullptr)},
          {"volume", volume_json(verdict)},
          {"shape", measured ? interfaces_json(verdict.audit.shape) : ordered_json(nullptr)},
          {"distance", measured_distance(verdict)},
          {"topology", topology_json(verdict)},
          {"performance",
           {{"wall_s", resources.wall_seconds},
            {"cpu_s", resources.cpu_seconds},
            {"peak_rss_bytes", resources.peak_rss_bytes}}}};
}

int run_verify(VerifyJob& job) {
  job.options.resolve();
  require_path(job.mesh, "MESH");
  check_choice(job.choice);
  if (job.audit.count_places && (job.choice.labels || job.choice.background)) {
    throw Error(ErrorKind::kUsage,
                "--topology interfaces: is for meshes of all labels, without --labels and "
                "--background");
  }
  const ResourceMeter meter;
  std::optional<io::AtomicFile> report;
  if (!job.report.empty()) report.emplace(job.report);
  const Verdict verdict = judge(job);
  print_verdict(verdict);
  if (report) write_json(*report, verify_report(job, verdict, meter.read()));
  return verdict.audit.passed() ? kExitDone : kExitCheckFailed;
}

}  // namespace

void add_verify_command(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand("verify", "checks a mesh against its volume");
  const auto job = std::make_shared<VerifyJob>();
  add_verify_options(*job);
  job->options.add_flags(*command);
  command->callback([job, &chosen] { chosen = [job] { return run_verify(*job); }; });
}

}  // namespace mw::cli
