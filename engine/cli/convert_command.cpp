// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh convert: a mesh from one format to another.
#include <algorithm>
#include <iostream>
#include <optional>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/options/file_names.h"
#include "engine/cli/options/mesh_options.h"
#include "engine/cli/requests.h"
#include "engine/finish/passes.h"
#include "engine/finish/select_labels.h"
#include "engine/report/connect_report.h"
#include "engine/settings/size_text.h"
#include "engine/system/crew.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/open_mesh.h"
#include "io/mesh/scratch_mesh.h"
#include "io/volume/open_volume.h"

namespace mw::cli {
namespace {

struct ConvertJob {
  std::filesystem::path from;
  std::filesystem::path to;
  std::optional<io::Element> element;  ///< empty: that of the file
  std::uint64_t pieces = 0;            ///< 0: not asked for
  bool force = false;                  ///< whether it may replace files of others
  io::MeshExtras extras;
  std::filesystem::path names;  ///< empty: those of the mesh
  engine::LabelChoice choice;
  engine::ConnectOptions connect;
  std::vector<engine::SampleImage> samples;
};

void check_files(const ConvertJob& job) {
  FileNames files;
  files.read_mesh(job.from);
  files.write_mesh(job.to, job.extras.materials.has_value());
  files.write("--pairs", job.extras.pairs);
  if (!job.names.empty()) files.read("--names", job.names);
  for (const engine::SampleImage& sample : job.samples) files.read("--sample", sample.file);
  files.require_apart();
  if (!job.force) files.require_own();
}

std::unique_ptr<io::MeshSink> open_output(const ConvertJob& job, io::Element element) {
  const bool in_pieces = job.to.extension() == io::kPiecesExtension;
  io::MeshExtras extras = job.extras;
  extras.wedges = job.connect.cohesive.any();
  if (!in_pieces && job.pieces == 0) return io::open_mesh_sink(job.to, element, extras);
  if (in_pieces && job.pieces == 0) {
    io::fail_usage(job.to.string() + ": a mesh in pieces; say how many with --pieces N");
  }
  if (job.extras.encoding == io::Encoding::kText || job.extras.materials ||
      job.extras.deck != io::Deck::kNone || element != io::Element::kTet4 ||
      !job.extras.pairs.empty()) {
    io::fail_usage(job.to.string() +
                   ": pieces are written with tet4 only, in one way, without "
                   "--materials, --deck and --pairs");
  }
  return io::open_mesh_pieces(job.to, job.pieces);
}

/// Which nodes the tets of the file have, and those that are written.
struct Nodes {
  io::Element of_file = io::Element::kTet4;
  io::Element written = io::Element::kTet4;
  std::string no_middles{};  ///< why the file's middles are not written; empty if they are
};

io::Element element_of(const io::MeshHeader& file) {
  if (file.in_parts) return io::Element::kCurvedTet10;
  return file.ten_nodes ? io::Element::kTet10 : io::Element::kTet4;
}

Nodes nodes_of(const io::MeshHeader& file, const ConvertJob& job) {
  Nodes out{.of_file = element_of(file)};
  if (!job.element && io::has_middles(out.of_file)) {
    out.no_middles = io::why_no_middles(job.to, file.record.cohesive.any());
  }
  out.written = job.element.value_or(out.no_middles.empty() ? out.of_file : io::Element::kTet4);
  return out;
}

/// Says what the new file does not have, or not as the mesh had it.
void tell_left_out(const io::MeshHeader& file, const Nodes& nodes, const ConvertJob& job) {
  if (!nodes.no_middles.empty()) {
    std::cout << "left out: middles of edges; " << nodes.no_middles << std::endl;
  } else if (!job.element && nodes.written == io::Element::kTet10) {
    std::cout << "tets keep ten nodes, those of edges in their middles; --element tet4 leaves "
                 "these out"
              << std::endl;
  }
  if (nodes.of_file == io::Element::kCurvedTet10 && nodes.written != nodes.of_file) {
    std::cout << "each curved tet is written as eight of its parts" << std::endl;
  }
  const std::string why = io::why_no_values(job.to);
  if (file.values.empty() || why.empty() || job.extras.materials) return;
  std::cout << "left out: values " << joined(file.values, ", ") << "; " << why << std::endl;
}

/// Opens the images that tets get values from.  A mesh does not tell where the voxels of its volume
/// were, so that an image must tell where it lies.
std::vector<engine::SampleImage> opened_samples(const ConvertJob& job, const io::MeshHeader& file) {
  std::vector<engine::SampleImage> out = job.samples;
  for (engine::SampleImage& sample : out) {
    if (std::find(file.values.begin(), file.values.end(), sample.name) != file.values.end()) {
      io::fail_usage("--sample ", sample.name, ": ", job.from.string(),
                     " has values of that name; give another one");
    }
    sample.image = io::open_volume(sample.file, {.dataset = sample.dataset});
    if (sample.image->info().is_placed) continue;
    io::fail_usage("--sample ", sample.name, ": ", sample.file,
                   " does not say where it lies, and a mesh not which voxels it was made of; give "
                   "an image in a format that has a place, such as NIfTI");
  }
  return out;
}

/// Changes the mesh as the options ask.
void change(io::ScratchMesh& mesh, const ConvertJob& job) {
  io::MeshHeader& header = mesh.header();
  const bool looks_at_tets = job.connect.change_mesh() || !job.samples.empty();
  const bool stays_curved = job.element.value_or(io::Element::kCurvedTet10) != io::Element::kTet4;
  if (header.in_parts && looks_at_tets && stays_curved) {
    io::fail_usage(job.from.string(),
                   ": --parts, --split, --cohesive, --open-hinges and --sample are for straight "
                   "tets, and these are curved; give --element tet4");
  }
  if (!job.names.empty()) header.names = header.names.merged_with(names_in(job.names));
  if (job.connect.split.any() || job.connect.cohesive.any()) {
    check_interfaces(job.connect, engine::labels_of(mesh));
  }
  engine::FinishTask task{.labels = job.choice,
                          .connect = {.options = job.connect, .threads = engine::thread_count(0)}};
  task.is_curved = job.element == io::Element::kCurvedTet10 && !header.in_parts;
  std::optional<engine::ImageSampler> sampler;
  if (!job.samples.empty()) {
    io::VolumeInfo world;
    world.space.frame = header.record.frame;
    world.space.unit = header.record.unit;
    sampler.emplace(opened_samples(job, header), world, engine::thread_count(0));
    task.samples = &*sampler;
  }
  const engine::FinishFacts facts = engine::apply_passes(mesh, task);
  if (facts.connected) std::cout << report::connect_text(*facts.connected) << std::endl;
}

int run_convert(const ConvertJob& job) {
  check_files(job);
  // What cannot be written fails before the mesh is read.
  static_cast<void>(open_output(job, job.element.value_or(io::Element::kTet4)));
  io::ScratchMesh mesh(io::scratch_folder());
  io::ScratchMeshSink from_file(mesh);
  io::copy_mesh(job.from, from_file);
  change(mesh, job);
  const Nodes nodes = nodes_of(mesh.header(), job);
  mesh.copy_to(*open_output(job, nodes.written));
  tell_left_out(mesh.header(), nodes, job);
  return kExitDone;
}

std::uint64_t parse_pieces(const std::string& text) {
  constexpr std::int64_t kMaxPieces = 1 << 20;
  const std::int64_t pieces = parse_integer(text);
  if (pieces >= 1 && pieces <= kMaxPieces) return static_cast<std::uint64_t>(pieces);
  io::fail_usage("expected pieces from 1 to " + std::to_string(kMaxPieces));
}

void add_output_options(OptionSet& options, ConvertJob& job) {
  options.add({.name = "out",
               .value = "OUT",
               .help = "mesh to write; its extension says the format",
               .group = kOutputGroup,
               .flags = "OUT,-o,--out",
               .required = true,
               .assign = into(job.to)});
  options.add({.name = "element",
               .value = "NAME",
               .help = "tet4; tet10: also nodes on edges; tet10-curved: on curves [MESH's]",
               .group = kOutputGroup,
               .choices = {"tet4", "tet10", "tet10-curved"},
               .assign = into(job.element, parse_element)});
  add_format_options(options, job.extras, Listed::kInHelp);
  options.add({.name = "pieces",
               .value = "N",
               .help = "a .pvtu and N .vtu beside it; vertices have GlobalNodeIds",
               .group = kOutputGroup,
               .kind = ValueKind::kInteger,
               .assign = into(job.pieces, parse_pieces)});
  add_force_option(options, job.force);
}

void add_change_options(OptionSet& options, ConvertJob& job) {
  add_choice_options(options, job.choice);
  options.add({.name = "names",
               .value = "FILE",
               .help = "names and colours of labels, in the place of the mesh's",
               .group = kLabelGroup,
               .assign = into(job.names)});
  add_connect_options(options, job.connect);
  add_sample_option(options, job.samples);
}

}  // namespace

Command convert_command() {
  const auto job = std::make_shared<ConvertJob>();
  Command command{.name = "convert",
                  .about = "writes a mesh in another format, or changed",
                  .options = {},
                  .run = [job](const OptionSet&) { return run_convert(*job); },
                  .note = mesh_note() + "OUT: " + io::mesh_extensions() + ".\n",
                  .names = [job] { return names_of(job->from); }};
  add_mesh_option(command.options, job->from, "mesh to read");
  add_change_options(command.options, *job);
  add_output_options(command.options, *job);
  return command;
}

}  // namespace mw::cli
