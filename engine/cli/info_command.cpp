// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh info: facts of a volume or a mesh.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/mesh_facts.h"
#include "engine/cli/volume_options.h"
#include "io/labels/label_set.h"
#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"
#include "io/mesh/tee_sink.h"

namespace mw::cli {
namespace {

using nlohmann::ordered_json;

struct InfoJob {
  OptionSet options;
  VolumeRequest volume;
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
  const std::unique_ptr<io::LabelVolume> volume = open(request);
  const io::VolumeInfo& info = volume->info();
  return {{"kind", "volume"},
          {"file", request.path.string()},
          {"format", info.format},
          {"type", io::name(info.type)},
          {"shape_xyz", {info.shape.x, info.shape.y, info.shape.z}},
          {"spacing_xyz", info.spacing},
          {"origin_xyz", info.origin},
          {"voxels", info.shape.product()},
          {"labels", labels_json(io::collect_labels(*volume))}};
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

ordered_json mesh_facts(const std::filesystem::path& path) {
  FactSink facts;
  io::DigestSink digest(io::scratch_folder());
  io::TeeSink both(facts, digest);
  io::copy_mesh(path, both);
  ordered_json out{{"kind", "mesh"}, {"file", path.string()}};
  out.update(facts.json());
  out["digest"] = digest.digest();
  return out;
}

std::string plain_text(const ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string out;
  for (const ordered_json& element : value) out += (out.empty() ? "" : " ") + element.dump();
  return out;
}

/// One line a fact; those of an object are named "object.fact".
void print_facts(const ordered_json& facts, const std::string& prefix = {}) {
  for (const auto& [key, value] : facts.items()) {
    std::string name = prefix + key;
    if (value.is_object()) {
      print_facts(value, name + ".");
      continue;
    }
    name.resize(std::max<std::size_t>(name.size(), 13), ' ');
    std::cout << name << " " << plain_text(value) << "\n";
  }
}

int run_info(InfoJob& job) {
  job.options.resolve();
  require_path(job.volume.path, "FILE");
  const bool is_mesh = is_mesh_name(job.volume.path) && !job.volume.shape;
  const ordered_json facts = is_mesh ? mesh_facts(job.volume.path) : volume_facts(job.volume);
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
  job->options.add(
      {.name = "file",
       .value = "FILE",
       .help = "volume or mesh",
       .flags = "FILE,--file",
       .assign = [job = job.get()](const std::string& text) { job->volume.path = text; }});
  add_volume_options(job->options, job->volume);
  job->options.add_flags(*command);
  command->add_flag("--json", job->json, "as JSON");
  command->callback([job, &chosen] { chosen = [job] { return run_info(*job); }; });
}

}  // namespace mw::cli
