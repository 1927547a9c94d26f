// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh stats: labels of a mesh one by one, and who touches whom.
#include <CLI/CLI.hpp>
#include <iostream>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/stats/stats_facts.h"
#include "engine/cli/stats/stats_json.h"
#include "engine/cli/stats/stats_tables.h"
#include "io/json/json.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/open_mesh.h"
#include "io/names/read_names.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

using io::Json;

struct StatsJob {
  OptionSet options;
  std::filesystem::path mesh;
  VolumeRequest volume;  ///< without path: none
  bool json = false;
  bool csv = false;
  bool contacts = false;
  bool no_betti = false;
};

void print_text(const StatsFacts& facts, bool contacts_only) {
  if (!contacts_only) {
    print_columns(label_table(facts, Digits::kSix, LabelColumns::kSizes), std::cout);
    std::cout << '\n';
    print_columns(label_table(facts, Digits::kSix, LabelColumns::kPlaces), std::cout);
    std::cout << '\n';
  }
  print_columns(contact_table(facts, Digits::kSix), std::cout);
}

io::LabelNames more_names(const StatsJob& job, const std::optional<VolumeSide>& volume) {
  if (volume) return volume->counts.names;
  return job.volume.names.empty() ? io::LabelNames() : io::read_names(job.volume.names);
}

int run_stats(StatsJob& job) {
  job.options.resolve();
  require_path(job.mesh, "MESH");
  if (job.json && job.csv) throw Error(ErrorKind::kUsage, "--json and --csv: only one of them");
  std::optional<VolumeSide> volume;
  if (!job.volume.path.empty()) volume = look_at_volume(job.volume);
  io::GroupedSink sink(io::scratch_folder(), nullptr);
  io::copy_mesh(job.mesh, sink);
  const io::LabelNames names = sink.mesh().names().merged_with(more_names(job, volume));
  const StatsFacts facts{sink.mesh().table(), names, measure_mesh(sink.mesh(), !job.no_betti),
                         std::move(volume)};
  if (job.json) {
    std::cout << stats_json(facts).dump_indented() << "\n";
  } else if (job.csv) {
    print_csv(job.contacts ? contact_table(facts, Digits::kAll)
                           : label_table(facts, Digits::kAll, LabelColumns::kBoth),
              std::cout);
  } else {
    print_text(facts, job.contacts);
  }
  return kExitDone;
}

}  // namespace

void add_stats_command(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand(
      "stats", "volume, area, topology and shape of each label, and areas of contact");
  const auto job = std::make_shared<StatsJob>();
  job->options.add({.name = "mesh",
                    .value = "MESH",
                    .help = "mesh to measure: " + io::read_mesh_extensions(),
                    .flags = "MESH,--mesh",
                    .assign = [job = job.get()](const std::string& text) { job->mesh = text; }});
  job->options.add(
      {.name = "volume",
       .value = "VOLUME",
       .help = "the volume that it was made from, for voxels and errors",
       .flags = "VOLUME,--volume",
       .assign = [job = job.get()](const std::string& text) { job->volume.path = text; }});
  add_volume_options(job->options, job->volume);
  job->options.add_flags(*command);
  command->add_flag("--json", job->json, "as JSON, with all digits");
  command->add_flag("--csv", job->csv, "labels as comma-separated values, with all digits");
  command->add_flag("--contacts", job->contacts, "contacts only (with --csv: instead of labels)");
  command->add_flag("--no-betti", job->no_betti,
                    "no components and Betti numbers, which need the mesh in memory");
  command->callback([job, &chosen] { chosen = [job] { return run_stats(*job); }; });
}

}  // namespace mw::cli
