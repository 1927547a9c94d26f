// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh convert: a mesh from one format to another.
#include <iostream>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/options/file_names.h"
#include "engine/cli/options/shared_options.h"
#include "engine/cli/options/values.h"
#include "engine/settings/size_text.h"
#include "io/file/errors.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/open_mesh.h"

namespace mw::cli {
namespace {

struct ConvertJob {
  std::filesystem::path from;
  std::filesystem::path to;
  io::Element element = io::Element::kTet4;
  std::uint64_t pieces = 0;  ///< 0: not asked for
  bool force = false;        ///< whether it may replace files of others
  io::MeshExtras extras;
};

/// Remembers what a mesh has that not every file can have.
class SourceFacts : public io::NoSink {
 public:
  void begin(const io::MeshHeader& header) override {
    values_ = header.values;
    is_curved_ = header.in_parts;
  }
  [[nodiscard]] const std::vector<std::string>& values() const { return values_; }
  [[nodiscard]] bool is_curved() const { return is_curved_; }

 private:
  std::vector<std::string> values_;
  bool is_curved_ = false;
};

void check_files(const ConvertJob& job) {
  FileNames files;
  files.read_mesh(job.from);
  files.write_mesh(job.to, job.extras.materials.has_value());
  files.write("--pairs", job.extras.pairs);
  files.require_apart();
  if (!job.force) files.require_own();
}

std::unique_ptr<io::MeshSink> open_output(const ConvertJob& job) {
  const bool in_pieces = job.to.extension() == io::kPiecesExtension;
  if (!in_pieces && job.pieces == 0) return io::open_mesh_sink(job.to, job.element, job.extras);
  if (in_pieces && job.pieces == 0) {
    io::fail_usage(job.to.string() + ": a mesh in pieces; say how many with --pieces N");
  }
  if (job.extras.encoding == io::Encoding::kText || job.extras.materials || job.extras.deck ||
      job.element != io::Element::kTet4 || !job.extras.pairs.empty()) {
    io::fail_usage(job.to.string() +
                   ": pieces are written with tet4 only, in one way, without "
                   "--materials, --deck and --pairs");
  }
  return io::open_mesh_pieces(job.to, job.pieces);
}

/// Says what the new file does not have, or not as the mesh had it.
void tell_left_out(const ConvertJob& job, const SourceFacts& source) {
  if (source.is_curved()) {
    std::cout << "each curved tet is written as eight of its parts" << std::endl;
  }
  const std::string why = io::why_no_values(job.to);
  if (source.values().empty() || why.empty() || job.extras.materials) return;
  std::cout << "left out: values " << joined(source.values(), ", ") << "; " << why << std::endl;
}

int run_convert(const ConvertJob& job) {
  check_files(job);
  const std::unique_ptr<io::MeshSink> sink = open_output(job);
  SourceFacts source;
  io::TeeSink both(*sink, source);
  io::copy_mesh(job.from, both);
  tell_left_out(job, source);
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
               .help = "tet4; tet10: also nodes on edges; tet10-curved: on curves",
               .group = kOutputGroup,
               .fallback = "tet4",
               .choices = {"tet4", "tet10", "tet10-curved"},
               .assign = into(job.element, parse_element)});
  options.add({.name = "ascii",
               .help = "a .msh as text instead of binary",
               .group = kOutputGroup,
               .kind = ValueKind::kSwitch,
               .assign = into(job.extras.encoding, parse_ascii)});
  options.add({.name = "materials",
               .value = "NAME=N[:LO:HI]",
               .help = "N sets of elements by equal ranges of the values NAME, with a table",
               .group = kOutputGroup,
               .assign = into(job.extras.materials, engine::parse_materials)});
  options.add({.name = "deck",
               .help = "static: a job for CalculiX or FEBio that pulls the mesh",
               .group = kOutputGroup,
               .fallback = "none",
               .choices = {"none", "static"},
               .assign = into(job.extras.deck, parse_deck)});
  options.add({.name = "pairs",
               .value = "FILE",
               .help = "nodes of --periodic faces: .csv, or equations in .inp",
               .group = kOutputGroup,
               .assign = into(job.extras.pairs)});
  options.add({.name = "pieces",
               .value = "N",
               .help = "a .pvtu and N .vtu beside it; vertices have GlobalNodeIds",
               .group = kOutputGroup,
               .kind = ValueKind::kInteger,
               .assign = into(job.pieces, parse_pieces)});
  add_force_option(options, job.force);
}

}  // namespace

Command convert_command() {
  const auto job = std::make_shared<ConvertJob>();
  Command command{.name = "convert",
                  .about = "writes a mesh in another format",
                  .options = {},
                  .run = [job](const OptionSet&) { return run_convert(*job); },
                  .note = mesh_note() + "OUT: " + io::mesh_extensions() + ".\n"};
  add_mesh_option(command.options, job->from, "mesh to read");
  add_output_options(command.options, *job);
  return command;
}

}  // namespace mw::cli
