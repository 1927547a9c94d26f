// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh info: facts of a volume or a mesh.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/fact_text.h"
#include "engine/cli/report_names.h"
#include "engine/cli/shape_sink.h"
#include "engine/cli/volume_facts.h"
#include "engine/cli/volume_options.h"
#include "engine/cli/voxel_counts.h"
#include "io/json/json.h"
#include "io/labels/label_set.h"
#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"
#include "io/mesh/tee_sink.h"
#include "io/names/read_names.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

using io::Json;

struct InfoJob {
  OptionSet options;
  std::filesystem::path file;
  VolumeRequest volume;  ///< of a mesh: --volume; else the file
  bool json = false;
};

Json labels_json(const io::LabelTable& table) {
  if (table.size() == 0) return {{"count", 0}, {"min", nullptr}, {"max", nullptr}};
  const auto last = static_cast<Label>(table.size() - 1);
  return {{"count", table.size()},
          {"min", label_json(table.raw(0), table.is_signed())},
          {"max", label_json(table.raw(last), table.is_signed())}};
}

/// What a mesh that streams by tells of itself.
class FactSink : public io::MeshSink {
 public:
  void begin(const io::MeshHeader& header) override { header_ = header; }
  void write_vertices(std::span<const io::Position> positions) override {
    for (const io::Position& v : positions) {
      if (vertices_++ == 0) lo_ = hi_ = v;
      for (std::size_t i = 0; i < 3; ++i) {
        lo_[i] = std::min(lo_[i], v[i]);
        hi_[i] = std::max(hi_[i], v[i]);
      }
    }
  }
  void write_tets(std::span<const io::TetRows>, std::span<const RawLabel> labels) override {
    labels_.insert(labels);
  }
  void finish() override {}

  [[nodiscard]] bool labels_signed() const { return header_.labels_signed; }
  [[nodiscard]] const io::LabelNames& names() const { return header_.names; }
  [[nodiscard]] Json json() const {
    return {{"vertices", vertices_},
            {"tets", header_.tets},
            {"labels", labels_json(io::LabelTable(labels_.values(), header_.labels_signed))},
            {"box", vertices_ == 0 ? Json(nullptr) : Json{{"lo", lo_}, {"hi", hi_}}}};
  }

 private:
  io::MeshHeader header_;
  std::uint64_t vertices_ = 0;
  io::Position lo_{};
  io::Position hi_{};
  io::LabelSet labels_;
};

/// Volumes of labels, and their errors when there is a volume to hold them against.
Json volumes_json(const ShapeSink& shape, bool labels_signed, const io::LabelNames& names,
                  const std::optional<VoxelCounts>& counts) {
  std::vector<RawLabel> labels;
  audit::CompensatedSum total;
  for (const auto& [label, volume] : shape.volumes()) {
    labels.push_back(label);
    total.add(volume.value());
  }
  const io::LabelTable table(std::move(labels), labels_signed);
  audit::VolumeMeter errors;
  Json rows = Json::array();
  for (Label l = 0; l < table.size(); ++l) {
    const double volume = shape.volumes().at(table.raw(l)).value();
    Json row = named_row_json(table.raw(l), labels_signed, names);
    row["volume"] = volume;
    row["share"] = volume / total.value();
    if (counts) {
      if (const auto held = held_against(*counts, table.raw(l), l, volume)) {
        errors.add(*held);
        row.update(volume_row_json(*held, table, names));
      }
    }
    add_colour(row, table.raw(l), names);
    rows.push_back(std::move(row));
  }
  Json out{{"total", total.value()}};
  if (counts) out.update(volume_summary_json(errors.summary(), table));
  out["per_label"] = std::move(rows);
  return out;
}

/// names: more of them than the mesh has; they win.
Json mesh_facts(const std::filesystem::path& path, const io::LabelNames& names,
                const std::optional<VoxelCounts>& counts) {
  FactSink facts;
  io::DigestSink digest(io::scratch_folder());
  ShapeSink shape(io::scratch_folder());
  io::TeeSink measured(facts, shape);
  io::TeeSink all(measured, digest);
  io::copy_mesh(path, all);
  Json out{{"kind", "mesh"}, {"file", path.string()}};
  out.update(facts.json());
  out["shape"] = interfaces_json(shape.shape());
  out["volume"] =
      volumes_json(shape, facts.labels_signed(), facts.names().merged_with(names), counts);
  out["digest"] = digest.digest();
  return out;
}

void print_json(const Json& facts) {
  std::cout << facts.dump_indented() << "\n";
}

void tell_of_mesh(const InfoJob& job) {
  std::optional<VoxelCounts> counts;
  io::LabelNames names;
  if (!job.volume.path.empty()) {
    counts = count_voxels(job.volume);
    names = counts->names;
  } else if (!job.volume.names.empty()) {
    names = io::read_names(job.volume.names);
  }
  const Json facts = mesh_facts(job.file, names, counts);
  job.json ? print_json(facts) : print_facts(facts);
}

int run_info(InfoJob& job) {
  job.options.resolve();
  require_path(job.file, "FILE");
  const bool has_volume = !job.volume.path.empty();
  // --shape says that a file is raw; without --volume there is no other file.
  if (io::is_mesh_path(job.file) && (has_volume || !job.volume.shape)) {
    tell_of_mesh(job);
    return kExitDone;
  }
  if (has_volume) throw Error(ErrorKind::kUsage, "--volume: FILE must be a mesh then");
  job.volume.path = job.file;
  const VolumeFacts facts(job.volume);
  job.json ? print_volume_json(facts) : print_volume(facts);
  return kExitDone;
}

}  // namespace

void add_info_command(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand("info", "facts of a volume or mesh");
  const auto job = std::make_shared<InfoJob>();
  job->options.add({.name = "file",
                    .value = "FILE",
                    .help = "volume or mesh",
                    .flags = "FILE,--file",
                    .assign = [job = job.get()](const std::string& text) { job->file = text; }});
  job->options.add(
      {.name = "volume",
       .value = "VOLUME",
       .help = "of a mesh: the volume that it was made from, for the errors of its label volumes",
       .assign = [job = job.get()](const std::string& text) { job->volume.path = text; }});
  add_volume_options(job->options, job->volume);
  job->options.add_flags(*command);
  command->add_flag("--json", job->json, "as JSON");
  command->callback([job, &chosen] { chosen = [job] { return run_info(*job); }; });
}

}  // namespace mw::cli
