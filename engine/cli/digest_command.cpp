// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh digest: the digest of a mesh's content.
#include <iostream>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/options/shared_options.h"
#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"

namespace mw::cli {

Command digest_command() {
  const auto mesh = std::make_shared<std::filesystem::path>();
  Command command{
      .name = "digest",
      .about = "prints the digest of a mesh, the same in every format and order of corners",
      .options = {},
      .run =
          [mesh](const OptionSet&) {
            io::DigestSink sink(io::scratch_folder());
            io::copy_mesh(*mesh, sink);
            std::cout << sink.digest() << "\n";
            return kExitDone;
          },
      .note = mesh_note()};
  add_mesh_option(command.options, *mesh, "mesh to read");
  return command;
}

}  // namespace mw::cli
