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

int run_convert(const ConvertJob& job) {
  require_other_files(job);
  const io::Encoding encoding = job.ascii ? io::Encoding::kText : io::Encoding::kUsual;
  const std::unique_ptr<io::MeshSink> sink =
      io::open_mesh_sink(job.to, parse_element(job.element), encoding);
  io::copy_mesh(job.from, *sink);
  return kExitDone;
}

}  // namespace

void add_convert_command(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand("convert", "writes a mesh in another format");
  const auto job = std::make_shared<ConvertJob>();
  const std::string formats = io::mesh_extensions();
  command->add_option("MESH", job->from, "mesh to read: " + formats)->required();
  command->add_option("OUT", job->to, "mesh to write: " + formats)->required();
  command->add_flag("--ascii", job->ascii, "a .msh as text instead of binary");
  command
      ->add_option("--element", job->element,
                   "nodes of a tet in OUT: tet4; tet10, with the middles of its edges")
      ->type_name("ELEMENT")
      ->capture_default_str();
  command->callback([job, &chosen] { chosen = [job] { return run_convert(*job); }; });
}

}  // namespace mw::cli
