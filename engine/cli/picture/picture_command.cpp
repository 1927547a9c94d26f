// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh picture: a mesh as a PNG picture.
#include <iostream>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/options/file_names.h"
#include "engine/cli/options/shared_options.h"
#include "engine/cli/options/values.h"
#include "engine/cli/picture/picture_request.h"
#include "engine/cli/report_names.h"
#include "io/file/errors.h"
#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/open_mesh.h"
#include "io/names/read_names.h"

namespace mw::cli {
namespace {

void check(const PictureRequest& request) {
  if (request.output.extension() != ".png") {
    io::fail_usage("-o " + request.output.string() + ": pictures are written as .png");
  }
  FileNames files;
  files.read_mesh(request.mesh);
  files.read("--names", request.names);
  files.write("-o", request.output);
  files.require_apart();
}

/// Returns by rank whether a label was asked for.
std::vector<bool> asked_labels(const io::LabelTable& table, const std::vector<RawLabel>& labels) {
  std::vector<bool> shown(table.size());
  for (const RawLabel label : labels) {
    if (!table.contains(label)) {
      io::fail_usage("--labels: the mesh has no label " + format_label(label, table.is_signed()) +
                     "; mwmesh info lists its labels");
    }
    shown[table.dense(label)] = true;
  }
  return shown;
}

/// Chooses all labels except the surrounding one, and says which one that is.
std::vector<bool> inner_labels(io::GroupedMesh& mesh, const io::LabelNames& names) {
  const io::LabelTable& table = mesh.table();
  std::vector<bool> shown(table.size(), true);
  if (const std::optional<Label> around = picture::surrounding_label(mesh)) {
    shown[*around] = false;
    std::cout << "left out    label " << label_text(table.raw(*around), table.is_signed(), names)
              << ", which is around the others; --labels draws it\n";
  }
  return shown;
}

/// Returns the names in the mesh, and those of --names.
io::LabelNames names_of(const PictureRequest& request) {
  const io::LabelNames names = cli::names_of(request.mesh);
  return request.names.empty() ? names : names.merged_with(io::read_names(request.names));
}

/// Throws the error; one about the mesh names its file.
[[noreturn]] void fail(const std::filesystem::path& mesh, const Error& error) {
  const std::string what = error.what();
  if (error.kind() != ErrorKind::kInput || what.starts_with(mesh.string())) throw error;
  throw Error(error.kind(), mesh.string() + ": " + what);
}

/// Returns how many triangles it drew.
std::uint64_t draw_mesh(const PictureRequest& request, const io::TakeBytes& take) {
  io::GroupedSink sink(io::scratch_folder(), nullptr);
  io::copy_mesh(request.mesh, sink);
  io::GroupedMesh& mesh = sink.mesh();
  io::LabelNames names = mesh.names();
  if (!request.names.empty()) names = names.merged_with(io::read_names(request.names));
  picture::MeshScene scene(
      mesh,
      request.labels ? asked_labels(mesh.table(), *request.labels) : inner_labels(mesh, names),
      names);
  const picture::View view = request.view.value_or(picture::default_view(request.cut));
  if (request.cut) scene.cut(cut_plane(mesh.box(), *request.cut, view));
  return draw(scene,
              {.width = request.pixels[0],
               .height = request.pixels[1],
               .view = view,
               .lines = request.lines,
               .transparent = request.transparent},
              take);
}

int run_picture(const PictureRequest& request) {
  check(request);
  io::AtomicFile file(request.output);
  try {
    const std::uint64_t triangles =
        draw_mesh(request, [&](std::span<const std::byte> bytes) { file.append(bytes); });
    std::cout << "triangles   " << triangles << "\n";
  } catch (const Error& error) {
    fail(request.mesh, error);
  }
  file.commit();
  std::cout << "file        " << request.output.string() << "\n";
  return kExitDone;
}

}  // namespace

Command picture_command() {
  const auto request = std::make_shared<PictureRequest>();
  Command command{.name = "picture",
                  .about = "draws a mesh, or a cut through it",
                  .options = {},
                  .run = [request](const OptionSet&) { return run_picture(*request); },
                  .note = mesh_note(),
                  .names = [request] { return names_of(*request); }};
  add_picture_options(command.options, *request);
  return command;
}

}  // namespace mw::cli
