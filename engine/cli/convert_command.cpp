// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh convert: a mesh from one format to another.
#include <CLI/CLI.hpp>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/values.h"
#include "io/mesh/open_mesh.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

struct ConvertJob {
  std::string from;
  std::string to;
  bool ascii = false;
  std::string element = "tet4";
  std::uint64_t pieces = 0;  ///< 0: not asked for
};

/// The mesh is read while the other is written; what is beside that is not to be the mesh.
void require_other_files(const ConvertJob& job) {
  const std::vector<std::filesystem::path> files = io::mesh_files(job.to);
  for (std::size_t i = 1; i < files.size(); ++i) {
    std::error_code ignored;
    if (!std::filesystem::equivalent(job.from, files[i], ignored)) continue;
    throw Error(ErrorKind::kUsage, files[i].string() + ": this is the mesh to read");
  }
}

std::unique_ptr<io::MeshSink> open_output(const ConvertJob& job) {
  const io::Element element = parse_element(job.element);
  const bool in_pieces = std::filesystem::path(job.to).extension() == io::kPiecesExtension;
  if (!in_pieces && job.pieces == 0) {
    const io::Encoding encoding = job.ascii ? io::Encoding::kText : io::Encoding::kUsual;
    return io::open_mesh_sink(job.to, element, encoding);
  }
  if (in_pieces && job.pieces == 0) {
    throw Error(ErrorKind::kUsage, job.to + ": a mesh in pieces; say how many with --pieces N");
  }
  if (job.ascii || element != io::Element::kTet4) {
    throw Error(ErrorKind::kUsage, job.to + ": pieces are written with tet4 only, and in one way");
  }
  return io::open_mesh_pieces(job.to, job.pieces);
}

int run_convert(const ConvertJob& job) {
  require_other_files(job);
  const std::unique_ptr<io::MeshSink> sink = open_output(job);
  io::copy_mesh(job.from, *sink);
  return kExitDone;
}

}  // namespace

void add_convert_command(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand("convert", "writes a mesh in another format");
  const auto job = std::make_shared<ConvertJob>();
  command->add_option("MESH", job->from, "mesh to read: " + io::read_mesh_extensions())->required();
  command->add_option("OUT", job->to, "mesh to write: " + io::mesh_extensions())->required();
  command->add_flag("--ascii", job->ascii, "a .msh as text instead of binary");
  command
      ->add_option("--element", job->element,
                   "nodes of a tet in OUT: tet4; tet10, with the middles of its edges")
      ->type_name("ELEMENT")
      ->capture_default_str();
  command
      ->add_option(
          "--pieces", job->pieces,
          "writes OUT, a .pvtu, and so many .vtu files in a folder beside it, for programs "
          "on many processes; vertices of several pieces have one of GlobalNodeIds")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 20));
  command->callback([job, &chosen] { chosen = [job] { return run_convert(*job); }; });
}

}  // namespace mw::cli
