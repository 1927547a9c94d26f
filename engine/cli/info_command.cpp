// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh info: facts of a volume or a mesh.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/mesh_facts.h"
#include "engine/cli/shape_facts.h"
#include "engine/cli/shape_sink.h"
#include "engine/cli/speck_facts.h"
#include "engine/cli/volume_options.h"
#include "io/labels/label_set.h"
#include "io/labels/slabs.h"
#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"
#include "io/mesh/tee_sink.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

using nlohmann::ordered_json;

struct InfoJob {
  OptionSet options;
  std::filesystem::path file;
  VolumeRequest volume;  ///< of a mesh: --volume; else the file
  bool json = false;
};

bool is_mesh_name(const std::filesystem::path& path) {
  constexpr std::array<const char*, 6> kExtensions{".vtu", ".mesh", ".vtkhdf",
                                                   ".msh", ".inp",  ".node"};
  const std::string extension = path.extension().string();
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

ordered_json labels_json(const io::LabelTable& table) {
  if (table.size() == 0) return {{"count", 0}, {"min", nullptr}, {"max", nullptr}};
  const auto last = static_cast<Label>(table.size() - 1);
  return {{"count", table.size()},
          {"min", label_json(table.raw(0), table.is_signed())},
          {"max", label_json(table.raw(last), table.is_signed())}};
}

ordered_json volume_facts(const VolumeRequest& request) {
  const std::unique_ptr<io::LabelVolume> opened = open(request);
  const io::PreparedInput input(*opened, request.steps);
  const io::VolumeInfo& info = input.volume().info();
  ordered_json out{{"kind", "volume"},
                   {"file", request.path.string()},
                   {"format", info.format},
                   {"type", io::name(info.type)},
                   {"shape_xyz", {info.shape.x, info.shape.y, info.shape.z}},
                   {"spacing_xyz", info.space.spacing},
                   {"origin_xyz", info.space.origin},
                   {"voxels", info.shape.product()},
                   {"labels", labels_json(io::collect_labels(input.volume()))}};
  if (input.specks()) out["specks"] = specks_json(input.specks());
  return out;
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
  [[nodiscard]] ordered_json json() const {
    return {
        {"vertices", vertices_},
        {"tets", header_.tets},
        {"labels", labels_json(io::LabelTable(labels_.values(), header_.labels_signed))},
        {"box", vertices_ == 0 ? ordered_json(nullptr) : ordered_json{{"lo", lo_}, {"hi", hi_}}}};
  }

 private:
  io::MeshHeader header_;
  std::uint64_t vertices_ = 0;
  io::Position lo_{};
  io::Position hi_{};
  io::LabelSet labels_;
};

/// A volume as a mesh is held against it.
struct VoxelCounts {
  std::unordered_map<RawLabel, std::uint64_t> voxels;
  double voxel_volume = 1;  ///< cubic physical units
};

/// One pass over the volume in slabs of bounded memory.
VoxelCounts count_voxels(const VolumeRequest& request) {
  constexpr std::int64_t kSlabVoxels = 1 << 16;
  const std::unique_ptr<io::LabelVolume> opened = open(request);
  const io::PreparedInput input(*opened, request.steps);
  const io::LabelVolume& volume = input.volume();
  const io::VolumeInfo& info = volume.info();
  VoxelCounts out;
  for (const double edge : info.space.spacing) out.voxel_volume *= edge;
  std::vector<RawLabel> labels;
  const auto count = [&](const Box3& slab) {
    labels.resize(static_cast<std::size_t>(slab.voxels()));
    volume.read(slab, labels);
    for (std::size_t begin = 0, end = 0; begin < labels.size(); begin = end) {
      while (end < labels.size() && labels[end] == labels[begin]) ++end;
      out.voxels[labels[begin]] += end - begin;
    }
  };
  const Box3 all{{0, 0, 0}, info.shape};
  if (info.z_fastest) {
    io::for_each_x_slab(all, kSlabVoxels, count);
  } else {
    io::for_each_z_slab(all, kSlabVoxels, count);
  }
  return out;
}

/// A label of the mesh in the volume, if it is there.
std::optional<audit::VolumeRow> held_against(const VoxelCounts& counts, RawLabel label, Label rank,
                                             double volume) {
  const auto found = counts.voxels.find(label);
  if (found == counts.voxels.end()) return std::nullopt;
  const auto voxels = static_cast<double>(found->second);
  const double in_mesh = volume / counts.voxel_volume;
  return audit::VolumeRow{rank, found->second, in_mesh, (in_mesh - voxels) / voxels};
}

/// Volumes of labels, and their errors when there is a volume to hold them against.
ordered_json volumes_json(const ShapeSink& shape, bool labels_signed,
                          const std::optional<VoxelCounts>& counts) {
  std::vector<RawLabel> labels;
  audit::CompensatedSum total;
  for (const auto& [label, volume] : shape.volumes()) {
    labels.push_back(label);
    total.add(volume.value());
  }
  const io::LabelTable table(std::move(labels), labels_signed);
  audit::VolumeMeter errors;
  ordered_json rows = ordered_json::array();
  for (Label l = 0; l < table.size(); ++l) {
    const double volume = shape.volumes().at(table.raw(l)).value();
    ordered_json row{{"label", label_json(table.raw(l), labels_signed)},
                     {"volume", volume},
                     {"share", volume / total.value()}};
    if (counts) {
      if (const auto held = held_against(*counts, table.raw(l), l, volume)) {
        errors.add(*held);
        row.update(volume_row_json(*held, table));
      }
    }
    rows.push_back(std::move(row));
  }
  ordered_json out{{"total", total.value()}};
  if (counts) out.update(volume_summary_json(errors.summary(), table));
  out["per_label"] = std::move(rows);
  return out;
}

ordered_json mesh_facts(const std::filesystem::path& path,
                        const std::optional<VoxelCounts>& counts) {
  FactSink facts;
  io::DigestSink digest(io::scratch_folder());
  ShapeSink shape(io::scratch_folder());
  io::TeeSink measured(facts, shape);
  io::TeeSink all(measured, digest);
  io::copy_mesh(path, all);
  ordered_json out{{"kind", "mesh"}, {"file", path.string()}};
  out.update(facts.json());
  out["shape"] = interfaces_json(shape.shape());
  out["volume"] = volumes_json(shape, facts.labels_signed(), counts);
  out["digest"] = digest.digest();
  return out;
}

/// "label 3, volume 12.5".
std::string row_text(const ordered_json& row) {
  std::string out;
  for (const auto& [key, value] : row.items()) {
    out += (out.empty() ? "" : ", ") + key + " " + value.dump();
  }
  return out;
}

std::string plain_text(const ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string out;
  for (const ordered_json& element : value) out += (out.empty() ? "" : " ") + element.dump();
  return out;
}

/// One line a fact, and one for each object of a list; those of an object are named "object.fact".
void print_facts(const ordered_json& facts, const std::string& prefix = {}) {
  for (const auto& [key, value] : facts.items()) {
    std::string name = prefix + key;
    if (value.is_object()) {
      print_facts(value, name + ".");
      continue;
    }
    name.resize(std::max<std::size_t>(name.size(), 13), ' ');
    if (value.is_array() && !value.empty() && value.front().is_object()) {
      for (const ordered_json& row : value) std::cout << name << " " << row_text(row) << "\n";
      continue;
    }
    std::cout << name << " " << plain_text(value) << "\n";
  }
}

ordered_json facts_of(InfoJob& job) {
  const bool has_volume = !job.volume.path.empty();
  // --shape says that a file is raw; without --volume there is no other file.
  if (is_mesh_name(job.file) && (has_volume || !job.volume.shape)) {
    std::optional<VoxelCounts> counts;
    if (has_volume) counts = count_voxels(job.volume);
    return mesh_facts(job.file, counts);
  }
  if (has_volume) throw Error(ErrorKind::kUsage, "--volume: FILE must be a mesh then");
  job.volume.path = job.file;
  return volume_facts(job.volume);
}

int run_info(InfoJob& job) {
  job.options.resolve();
  require_path(job.file, "FILE");
  const ordered_json facts = facts_of(job);
  if (job.json) {
    std::cout << facts.dump(2, ' ', false, ordered_json::error_handler_t::replace) << "\n";
  } else {
    print_facts(facts);
  }
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
