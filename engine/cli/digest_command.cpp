// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh digest: the digest of a mesh's content.
#include <CLI/CLI.hpp>
#include <iostream>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"

namespace mw::cli {

void add_digest_command(CLI::App& program, Action& chosen) {
  CLI::App* command =
      program.add_subcommand("digest", "prints the digest of a mesh, the same in every format");
  const auto mesh = std::make_shared<std::string>();
  command->add_option("MESH", *mesh, "mesh: " + io::read_mesh_extensions())->required();
  command->callback([mesh, &chosen] {
    chosen = [mesh] {
      io::DigestSink sink(io::scratch_folder());
      io::copy_mesh(*mesh, sink);
      std::cout << sink.digest() << "\n";
      return kExitDone;
    };
  });
}

}  // namespace mw::cli
