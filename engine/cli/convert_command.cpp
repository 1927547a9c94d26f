// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh convert: a mesh from one format to another.
#include <CLI/CLI.hpp>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "io/mesh/open_mesh.h"

namespace mw::cli {
namespace {

int run_convert(const std::string& from, const std::string& to) {
  const std::unique_ptr<io::MeshSink> sink = io::open_mesh_sink(to);
  io::copy_mesh(from, *sink);
  return kExitDone;
}

}  // namespace

void add_convert_command(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand("convert", "writes a mesh in another format");
  const auto paths = std::make_shared<std::pair<std::string, std::string>>();
  command->add_option("MESH", paths->first, "mesh to read: " + io::mesh_extensions())->required();
  command->add_option("OUT", paths->second, "mesh to write: " + io::mesh_extensions())->required();
  command->callback(
      [paths, &chosen] { chosen = [paths] { return run_convert(paths->first, paths->second); }; });
}

}  // namespace mw::cli
