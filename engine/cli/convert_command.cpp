// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh convert: a mesh from one format to another.
#include <CLI/CLI.hpp>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "io/mesh/open_mesh.h"

namespace mw::cli {
namespace {

struct ConvertJob {
  std::string from;
  std::string to;
  bool ascii = false;
};

int run_convert(const ConvertJob& job) {
  const io::Encoding encoding = job.ascii ? io::Encoding::kText : io::Encoding::kUsual;
  const std::unique_ptr<io::MeshSink> sink =
      io::open_mesh_sink(job.to, io::Element::kTet4, encoding);
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
  command->callback([job, &chosen] { chosen = [job] { return run_convert(*job); }; });
}

}  // namespace mw::cli
