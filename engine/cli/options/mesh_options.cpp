// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cli/options/mesh_options.h"

#include "engine/cli/log.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/open_mesh.h"
#include "io/names/read_names.h"

namespace mw::cli {
namespace {

/// Takes what is known before the first row, and ends the reading by throwing Enough.
struct NamesSink : io::NoSink {
  struct Enough {};

  void begin(const io::MeshHeader& header) override {
    names = header.names;
    throw Enough();
  }

  io::LabelNames names;
};

}  // namespace

void add_force_option(OptionSet& options, bool& force) {
  options.add(switch_of(force, {.name = "force",
                                .help = "replaces files that are not of this program",
                                .group = kOutputGroup}));
}

void add_mesh_option(OptionSet& options, std::filesystem::path& mesh, const std::string& what) {
  options.add({.name = "mesh",
               .value = "MESH",
               .help = what,
               .group = kInputGroup,
               .flags = "MESH,--mesh",
               .required = true,
               .assign = into(mesh)});
}

io::LabelNames names_of(const std::filesystem::path& mesh) {
  NamesSink sink;
  try {
    io::copy_mesh(mesh, sink);
  } catch (const NamesSink::Enough&) {
    return sink.names;
  }
  return {};
}

io::LabelNames names_in(const std::filesystem::path& file) {
  std::string note;
  io::LabelNames names = io::read_names(file, &note);
  if (!note.empty()) log_warning(note);
  return names;
}

std::string mesh_note() {
  return "MESH: " + io::read_mesh_extensions() + ".\n";
}

}  // namespace mw::cli
