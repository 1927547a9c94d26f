// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh stats: labels of a mesh one by one, and who touches whom.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/mesh_facts.h"
#include "engine/cli/mesh_stats.h"
#include "engine/cli/name_facts.h"
#include "engine/cli/text_table.h"
#include "engine/cli/values.h"
#include "engine/cli/volume_options.h"
#include "engine/cli/voxel_counts.h"
#include "engine/label_contacts.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/open_mesh.h"
#include "io/names/read_names.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

using nlohmann::ordered_json;

struct StatsJob {
  OptionSet options;
  std::filesystem::path mesh;
  VolumeRequest volume;  ///< without path: none
  bool json = false;
  bool csv = false;
  bool contacts = false;
  bool no_betti = false;
};

/// What the volume says of what the mesh has.
struct VolumeSide {
  VoxelCounts counts;
  std::map<std::pair<RawLabel, RawLabel>, double> areas;  ///< of faces of voxels, by contact
};

VolumeSide look_at_volume(const VolumeRequest& request) {
  const std::unique_ptr<io::LabelVolume> opened = open(request);
  const io::PreparedInput input(*opened, request.steps);
  VolumeSide out{.counts = count_voxels(input.volume())};
  const auto& edge = input.volume().info().space.spacing;
  for (const engine::LabelContact& c : engine::label_contacts(input.volume())) {
    double area = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      area += static_cast<double>(c.faces[k]) * edge[(k + 1) % 3] * edge[(k + 2) % 3];
    }
    out.areas[{c.first, c.second}] = area;
  }
  return out;
}

/// Everything that is told, by rank of label.
struct Facts {
  const io::LabelTable& table;
  io::LabelNames names;
  MeshStats mesh;
  std::optional<VolumeSide> volume;
};

/// A contact of the mesh, the volume, or both.
struct Contact {
  RawLabel first = 0;
  RawLabel second = 0;
  std::uint64_t triangles = 0;
  double area = 0;
  std::optional<double> voxel_area;
};

/// Those of the mesh, then those that only the voxels have.
std::vector<Contact> contacts_of(const Facts& facts) {
  std::vector<Contact> out;
  auto unmet = facts.volume ? facts.volume->areas : decltype(facts.volume->areas)();
  for (const ContactStats& c : facts.mesh.contacts) {
    Contact contact{facts.table.raw(c.first), facts.table.raw(c.second), c.triangles, c.area, {}};
    const auto found = unmet.find(std::minmax(contact.first, contact.second));
    if (facts.volume) contact.voxel_area = found == unmet.end() ? 0 : found->second;
    if (found != unmet.end()) unmet.erase(found);
    out.push_back(contact);
  }
  for (const auto& [pair, area] : unmet) {
    const bool in_mesh = facts.table.contains(pair.first) && facts.table.contains(pair.second);
    if (in_mesh) out.push_back({pair.first, pair.second, 0, 0, area});
  }
  return out;
}

std::optional<audit::VolumeRow> voxels_of(const Facts& facts, Label rank) {
  if (!facts.volume) return std::nullopt;
  return held_against(facts.volume->counts, facts.table.raw(rank), rank,
                      facts.mesh.labels[rank].volume);
}

ordered_json betti_json(const audit::Betti& betti) {
  return {betti.b0, betti.b1, betti.b2};
}

ordered_json label_json(const Facts& facts, Label rank) {
  const LabelStats& label = facts.mesh.labels[rank];
  const RawLabel raw = facts.table.raw(rank);
  ordered_json row = named_row_json(raw, facts.table.is_signed(), facts.names);
  row["volume"] = label.volume;
  if (facts.volume) {
    const auto voxels = voxels_of(facts, rank);
    row["voxels"] = voxels ? ordered_json(voxels->voxels) : ordered_json(0);
    row["volume_error"] = voxels ? ordered_json(voxels->error) : ordered_json();
  }
  row["area"] = label.area;
  row["area_on_box"] = label.area_on_box;
  row["tets"] = label.tets;
  if (label.betti) {
    row["components"] = label.betti->open.b0;
    row["betti_closed"] = betti_json(label.betti->closed);
    row["betti_open"] = betti_json(label.betti->open);
  }
  row["radius_ratio_min"] = label.radius_ratio_min;
  row["radius_ratio_mean"] = label.radius_ratio_mean;
  row["lo"] = label.lo;
  row["hi"] = label.hi;
  row["centroid"] = label.centroid;
  add_colour(row, raw, facts.names);
  return row;
}

ordered_json contact_json(const Facts& facts, const Contact& contact) {
  const bool is_signed = facts.table.is_signed();
  ordered_json row{
      {"labels",
       {cli::label_json(contact.first, is_signed), cli::label_json(contact.second, is_signed)}},
      {"triangles", contact.triangles},
      {"area", contact.area}};
  if (contact.voxel_area) row["voxel_area"] = *contact.voxel_area;
  return row;
}

ordered_json stats_json(const Facts& facts) {
  ordered_json labels = ordered_json::array();
  for (Label rank = 0; rank < facts.table.size(); ++rank) labels.push_back(label_json(facts, rank));
  ordered_json contacts = ordered_json::array();
  for (const Contact& c : contacts_of(facts)) contacts.push_back(contact_json(facts, c));
  return {{"labels", std::move(labels)}, {"contacts", std::move(contacts)}};
}

/// Numbers of a table: whole for scripts, six digits for eyes.
class Digits {
 public:
  explicit Digits(bool all) : all_(all) {}

  [[nodiscard]] std::string operator()(double number) const {
    if (all_) return format_number(number);
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", number);
    return text.data();
  }

 private:
  bool all_;
};

using Fields = std::vector<std::string>;

void add_fields(Fields& row, std::initializer_list<std::string> fields) {
  row.insert(row.end(), fields);
}

void add_position(Fields& row, const io::Position& p, const Digits& digits) {
  for (const double x : p) row.push_back(digits(x));
}

Fields label_titles(const Facts& facts) {
  Fields titles{"label", "name", "volume"};
  if (facts.volume) add_fields(titles, {"voxels", "volume_error"});
  add_fields(titles, {"area", "area_on_box", "tets"});
  if (facts.mesh.labels.empty() || facts.mesh.labels.front().betti) {
    add_fields(titles, {"components", "b0", "b1", "b2"});
  }
  add_fields(titles, {"rr_min", "rr_mean"});
  return titles;
}

Fields label_fields(const Facts& facts, Label rank, const Digits& digits) {
  const LabelStats& label = facts.mesh.labels[rank];
  const RawLabel raw = facts.table.raw(rank);
  Fields row{format_label(raw, facts.table.is_signed()), facts.names.name(raw),
             digits(label.volume)};
  if (facts.volume) {
    const auto voxels = voxels_of(facts, rank);
    row.push_back(voxels ? std::to_string(voxels->voxels) : "0");
    row.push_back(voxels ? digits(voxels->error) : "");
  }
  add_fields(row, {digits(label.area), digits(label.area_on_box), std::to_string(label.tets)});
  if (label.betti) {
    add_fields(row,
               {std::to_string(label.betti->open.b0), std::to_string(label.betti->closed.b0),
                std::to_string(label.betti->closed.b1), std::to_string(label.betti->closed.b2)});
  }
  add_fields(row, {digits(label.radius_ratio_min), digits(label.radius_ratio_mean)});
  return row;
}

constexpr std::array kPlaceTitles{"lo_x", "lo_y",       "lo_z",       "hi_x",      "hi_y",
                                  "hi_z", "centroid_x", "centroid_y", "centroid_z"};

Fields place_fields(const LabelStats& label, const Digits& digits) {
  Fields row;
  for (const io::Position& p : {label.lo, label.hi, label.centroid}) add_position(row, p, digits);
  return row;
}

/// Labels without their places, or places alone, or both.
TextTable label_table(const Facts& facts, const Digits& digits, bool sizes, bool places) {
  Fields titles = sizes ? label_titles(facts) : Fields{"label"};
  if (places) titles.insert(titles.end(), kPlaceTitles.begin(), kPlaceTitles.end());
  TextTable table{titles};
  for (Label rank = 0; rank < facts.table.size(); ++rank) {
    Fields row = label_fields(facts, rank, digits);
    if (!sizes) row.resize(1);
    if (places) {
      const Fields place = place_fields(facts.mesh.labels[rank], digits);
      row.insert(row.end(), place.begin(), place.end());
    }
    table.push_back(row);
  }
  return table;
}

TextTable contact_table(const Facts& facts, const Digits& digits) {
  Fields titles{"first", "second", "triangles", "area"};
  if (facts.volume) titles.emplace_back("voxel_area");
  TextTable table{titles};
  for (const Contact& c : contacts_of(facts)) {
    const bool is_signed = facts.table.is_signed();
    Fields row{format_label(c.first, is_signed), format_label(c.second, is_signed),
               std::to_string(c.triangles), digits(c.area)};
    if (c.voxel_area) row.push_back(digits(*c.voxel_area));
    table.push_back(row);
  }
  return table;
}

void print_text(const Facts& facts, bool contacts_only) {
  const Digits digits(false);
  if (!contacts_only) {
    print_columns(label_table(facts, digits, true, false), std::cout);
    std::cout << '\n';
    print_columns(label_table(facts, digits, false, true), std::cout);
    std::cout << '\n';
  }
  print_columns(contact_table(facts, digits), std::cout);
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
  const Facts facts{sink.mesh().table(), names, measure_mesh(sink.mesh(), !job.no_betti),
                    std::move(volume)};
  if (job.json) {
    std::cout << stats_json(facts).dump(2, ' ', false, ordered_json::error_handler_t::replace)
              << "\n";
  } else if (job.csv) {
    const Digits digits(true);
    print_csv(job.contacts ? contact_table(facts, digits) : label_table(facts, digits, true, true),
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
                    .help = "mesh to measure: " + io::mesh_extensions(),
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
