// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh info: facts of a volume or a mesh.
#include <iostream>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/info/info_text.h"
#include "engine/cli/info/mesh_info.h"
#include "engine/cli/info/volume_facts.h"
#include "engine/cli/options/mesh_options.h"
#include "engine/cli/requests.h"
#include "engine/connect/connect_mesh.h"
#include "engine/finish/interface_shape.h"
#include "io/file/errors.h"
#include "io/mesh/digest.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/merged_vertices.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/open_mesh.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::cli {
namespace {

using io::Json;

struct InfoJob {
  std::filesystem::path file;
  VolumeRequest volume;  ///< --volume if the file is a mesh, else the file
  bool betti = false;
  bool contacts = false;
  bool json = false;
  bool csv = false;
};

constexpr std::size_t kSortBytes = 8 << 20;

MeshInfo look_at_mesh(const InfoJob& job) {
  std::optional<VolumeSide> volume;
  io::LabelNames more_names;
  if (!job.volume.path.empty()) {
    volume = look_at_volume(job.volume, job.contacts);
    more_names = volume->names;
  } else if (!job.volume.names.empty()) {
    more_names = names_in(job.volume.names);
  }
  const std::filesystem::path folder = io::scratch_folder();
  io::ScratchMesh stored(folder), single(folder);
  io::ScratchMeshSink from_file(stored), into_single(single);
  io::copy_mesh(job.file, from_file);
  io::MergedVertices merged(into_single, folder);
  stored.copy_to(merged);
  io::GroupedSink grouped(folder, nullptr);  // it checks rows before others look up their vertices
  io::GroupedMesh& mesh = grouped.view(single);
  io::DigestSink digest(folder);
  stored.copy_to(digest);
  return {.file = job.file.string(),
          .vertices = mesh.vertex_count() + merged.merged(),
          .tets = mesh.tet_count(),
          .curved = stored.header().in_parts ? mesh.tet_count() / kTetParts.size() : 0,
          .doubled = merged.merged(),
          .parts = engine::connect(stored, {}),
          .table = mesh.table(),
          .names = mesh.names().merged_with(more_names),
          .mesh = measure_mesh(mesh, job.betti),
          .volume = std::move(volume),
          .shape = engine::interface_shape(single, kSortBytes),
          .digest = digest.digest(),
          .cohesive = mesh.header().record.cohesive};
}

Columns size_columns() {
  return {{"label"},
          {.title = "name", .needs = "label"},
          {"volume"},
          {"voxels"},
          {.title = "volume_error", .needs = "voxels"},
          {"area"},
          {"area_on_box"},
          {"tets"},
          {"components"},
          {"b0", "betti_closed", 0},
          {"b1", "betti_closed", 1},
          {"b2", "betti_closed", 2},
          {"rr_min", "radius_ratio_min"},
          {"rr_mean", "radius_ratio_mean"}};
}

/// Adds millilitres where lengths are in mm.
Columns columns_for_people(const MeshInfo& facts) {
  Columns out = size_columns();
  if (!facts.volume || facts.volume->unit != "mm") return out;
  out[2].title = "mm3";
  out.insert(out.begin() + 3, {.title = "mL", .key = "volume", .unit = 1000});
  return out;
}

Columns with_places(Columns columns) {
  for (const std::string key : {"lo", "hi", "centroid"}) {
    for (std::size_t k = 0; k < 3; ++k) columns.push_back({key + "_" + "xyz"[k], key, k});
  }
  return columns;
}

Columns contact_columns() {
  return {{"first", "labels", 0}, {"second", "labels", 1}, {"triangles"}, {"area"}, {"voxel_area"}};
}

/// Prints what is not in the tables, and the tables.
void print_mesh(const MeshInfo& facts, bool contacts) {
  Json told = mesh_json(facts, contacts);
  const Json labels = std::move(told["volume"]["per_label"]);
  told["volume"].erase("per_label");
  const Json pairs = std::move(told["contacts"]);
  told.erase("contacts");
  print_facts(told);
  for (const Columns& columns : {columns_for_people(facts), with_places({{"label"}})}) {
    std::cout << '\n';
    print_columns(labels, columns);
  }
  if (!contacts) return;
  std::cout << '\n';
  print_columns(pairs, contact_columns());
}

void tell_of_mesh(const InfoJob& job) {
  const MeshInfo facts = look_at_mesh(job);
  if (job.json) {
    std::cout << mesh_json(facts, job.contacts).dump_indented() << "\n";
  } else if (!job.csv) {
    print_mesh(facts, job.contacts);
  } else if (job.contacts) {
    print_csv(mesh_json(facts, true)["contacts"], contact_columns());
  } else {
    print_csv(mesh_json(facts, false)["volume"]["per_label"], with_places(size_columns()));
  }
}

/// Returns whether the file is looked at as a mesh.  --shape says that a file is raw; without a
/// volume there is no other file.
bool is_about_mesh(const InfoJob& job) {
  return io::is_mesh_path(job.file) && (!job.volume.path.empty() || !job.volume.shape);
}

/// Throws for a flag about volumes, as there is none.  Variables may be meant for other commands.
void refuse_volume_flags(const OptionSet& options, const std::string& mesh) {
  VolumeRequest unused;
  OptionSet of_volumes;
  add_volume_options(of_volumes, unused);
  add_step_options(of_volumes, unused);
  for (const OptionSet::Entry& entry : of_volumes.entries()) {
    const std::string& name = entry.option.name;
    if (name == "names" || !options.is_flag(name)) continue;
    io::fail_usage("--" + name + ": says something of a volume, and " + mesh +
                   " is a mesh; leave it out, or name the volume behind the "
                   "mesh, as in mwmesh info " +
                   mesh + " VOLUME");
  }
}

int run_info(InfoJob& job, const OptionSet& options) {
  if (job.json && job.csv) io::fail_usage("--json and --csv: only one of them");
  const bool has_volume = !job.volume.path.empty();
  if (is_about_mesh(job)) {
    has_volume ? refuse_idle_cache(options, job.volume)
               : refuse_volume_flags(options, job.file.string());
    tell_of_mesh(job);
    return kExitDone;
  }
  if (has_volume) {
    io::fail_usage(job.file.string() + ": is no mesh, and FILE must be one where VOLUME is given");
  }
  if (job.betti || job.contacts || job.csv) {
    io::fail_usage("--betti, --contacts and --csv: FILE must be a mesh then");
  }
  job.volume.path = job.file;
  refuse_idle_cache(options, job.volume);
  const VolumeFacts facts(job.volume);
  job.json ? print_volume_json(facts) : print_volume(facts);
  return kExitDone;
}

void add_files(OptionSet& options, InfoJob& job) {
  options.add({.name = "file",
               .value = "FILE",
               .help = "volume or mesh to look at",
               .group = kInputGroup,
               .flags = "FILE,--file",
               .required = true,
               .assign = into(job.file)});
  options.add({.name = "volume",
               .value = "VOLUME",
               .help = "what the mesh was made from, for its voxels and errors",
               .group = kInputGroup,
               .flags = "VOLUME,--volume",
               .assign = into(job.volume.path)});
}

void add_switch(OptionSet& options, const char* name, const char* help, bool& target) {
  options.add(
      switch_of(target, {.name = name, .help = help, .group = kOutputGroup, .only_flag = true}));
}

}  // namespace

Command info_command() {
  const auto job = std::make_shared<InfoJob>();
  Command command{.name = "info",
                  .about = "tells facts of a volume or mesh, and of each label",
                  .options = {},
                  .run = [job](const OptionSet& options) { return run_info(*job, options); },
                  .older_name = "stats",
                  .note = volume_note() + mesh_note(),
                  .names =
                      [job] {
                        if (is_about_mesh(*job) && job->volume.path.empty()) {
                          return names_of(job->file);
                        }
                        VolumeRequest volume = job->volume;
                        if (volume.path.empty()) volume.path = job->file;
                        return names_of(volume);
                      }};
  add_files(command.options, *job);
  add_volume_options(command.options, job->volume);
  add_step_options(command.options, job->volume);
  add_switch(command.options, "betti",
             "of a mesh: components and Betti numbers, with the mesh in memory", job->betti);
  add_switch(command.options, "contacts", "of a mesh: which labels touch, and on what area",
             job->contacts);
  add_switch(command.options, "json", "as JSON, with all digits", job->json);
  add_switch(command.options, "csv",
             "labels of a mesh (with --contacts those) as CSV, with all digits", job->csv);
  return command;
}

}  // namespace mw::cli
