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
  std::optional<io::Element> element;  ///< empty: that of the file
  std::uint64_t pieces = 0;            ///< 0: not asked for
  bool force = false;                  ///< whether it may replace files of others
  io::MeshExtras extras;
};

void check_files(const ConvertJob& job) {
  FileNames files;
  files.read_mesh(job.from);
  files.write_mesh(job.to, job.extras.materials.has_value());
  files.write("--pairs", job.extras.pairs);
  files.require_apart();
  if (!job.force) files.require_own();
}

std::unique_ptr<io::MeshSink> open_output(const ConvertJob& job, io::Element element) {
  const bool in_pieces = job.to.extension() == io::kPiecesExtension;
  if (!in_pieces && job.pieces == 0) return io::open_mesh_sink(job.to, element, job.extras);
  if (in_pieces && job.pieces == 0) {
    io::fail_usage(job.to.string() + ": a mesh in pieces; say how many with --pieces N");
  }
  if (job.extras.encoding == io::Encoding::kText || job.extras.materials || job.extras.deck ||
      element != io::Element::kTet4 || !job.extras.pairs.empty()) {
    io::fail_usage(job.to.string() +
                   ": pieces are written with tet4 only, in one way, without "
                   "--materials, --deck and --pairs");
  }
  return io::open_mesh_pieces(job.to, job.pieces);
}

io::Element element_of(const io::MeshHeader& file) {
  if (file.in_parts) return io::Element::kCurvedTet10;
  return file.ten_nodes ? io::Element::kTet10 : io::Element::kTet4;
}

/// Opens the output when it is known which nodes the file's tets have; tells what it has not.
class ConvertSink : public io::MeshSink {
 public:
  explicit ConvertSink(const ConvertJob& job)
      : job_(job), below_(open_output(job, job.element.value_or(io::Element::kTet4))) {}

  void begin(const io::MeshHeader& header) override {
    values_ = header.values;
    of_file_ = element_of(header);
    const bool has_wedges = header.record.cohesive.any();
    if (!job_.element && io::has_middles(of_file_)) {
      no_middles_ = io::why_no_middles(job_.to, has_wedges);
    }
    written_ = job_.element.value_or(no_middles_.empty() ? of_file_ : io::Element::kTet4);
    if (!job_.element && io::has_middles(written_)) {
      below_.reset();
      below_ = open_output(job_, written_);
    }
    below_->begin(header);
  }
  void write_vertices(std::span<const io::Position> positions) override {
    below_->write_vertices(positions);
  }
  void write_tets(std::span<const io::TetRows> tets, std::span<const RawLabel> labels) override {
    below_->write_tets(tets, labels);
  }
  void write_values(std::span<const double> rows) override { below_->write_values(rows); }
  void finish() override { below_->finish(); }

  /// Says what the new file does not have, or not as the mesh had it.
  void tell() const {
    if (!no_middles_.empty()) {
      std::cout << "left out: middles of edges; " << no_middles_ << std::endl;
    } else if (!job_.element && written_ == io::Element::kTet10) {
      std::cout << "tets keep ten nodes, those of edges in their middles; --element tet4 leaves "
                   "these out"
                << std::endl;
    }
    if (of_file_ == io::Element::kCurvedTet10 && written_ != of_file_) {
      std::cout << "each curved tet is written as eight of its parts" << std::endl;
    }
    const std::string why = io::why_no_values(job_.to);
    if (values_.empty() || why.empty() || job_.extras.materials) return;
    std::cout << "left out: values " << joined(values_, ", ") << "; " << why << std::endl;
  }

 private:
  const ConvertJob& job_;
  std::unique_ptr<io::MeshSink> below_;
  io::Element of_file_ = io::Element::kTet4;
  io::Element written_ = io::Element::kTet4;
  std::vector<std::string> values_;
  std::string no_middles_;  ///< why the file's middles are not written; empty if they are
};

int run_convert(const ConvertJob& job) {
  check_files(job);
  ConvertSink sink(job);
  io::copy_mesh(job.from, sink);
  sink.tell();
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
