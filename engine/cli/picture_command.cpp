// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh picture: a mesh as a PNG picture.
#include <iostream>
#include <string_view>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/options/file_names.h"
#include "engine/cli/options/mesh_options.h"
#include "engine/cli/requests.h"
#include "engine/picture/draw.h"
#include "engine/report/mesh_facts.h"
#include "io/file/errors.h"
#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/open_mesh.h"
#include "io/names/read_names.h"

namespace mw::cli {
namespace {

/// What `mwmesh picture` is asked to draw.
struct PictureRequest {
  std::filesystem::path mesh;
  std::filesystem::path output;
  std::filesystem::path names;  ///< empty: those in the mesh
  std::optional<picture::CutPosition> cut;
  std::optional<std::vector<RawLabel>> labels;  ///< empty: all except the surrounding one
  std::optional<picture::View> view;            ///< empty: the view that suits the cut
  std::array<int, 2> pixels{1200, 900};         ///< width and height
  picture::Lines lines = picture::Lines::kAuto;
  bool transparent = false;
  bool has_legend = true;
  bool force = false;  ///< whether it may replace a file of others
};

constexpr const char* kShownGroup = "What to show";

[[noreturn]] void fail_expected(const std::string& what) {
  io::fail_usage("expected " + what);
}

std::array<int, 2> parse_pixels(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) fail_expected("pixels, as 1200x900");
  const std::int64_t width = parse_integer(text.substr(0, cross));
  const std::int64_t height = parse_integer(text.substr(cross + 1));
  picture::check_sides(width, height);
  return {static_cast<int>(width), static_cast<int>(height)};
}

picture::Lines parse_lines(const std::string& text) {
  using picture::Lines;
  if (text == "auto") return Lines::kAuto;
  return text == "on" ? Lines::kAll : Lines::kNone;
}

/// Parses "x=0.5".  ERRORS: mw::Error(kUsage) saying what was expected.
picture::CutPosition parse_cut(std::string_view text) {
  constexpr const char* kExpected = "x=SHARE, y=SHARE or z=SHARE with a share from 0 to 1";
  if (text.size() < 3 || text[0] < 'x' || text[0] > 'z' || text[1] != '=') fail_expected(kExpected);
  const picture::CutPosition position{.axis = static_cast<std::size_t>(text[0] - 'x'),
                                      .share = parse_number(text.substr(2))};
  if (position.share < 0 || position.share > 1) fail_expected(kExpected);
  return position;
}

/// Parses "iso", "x", "y", "z" (from the far end of that axis) or "AZIMUTH,ELEVATION" in degrees.
/// ERRORS: mw::Error(kUsage) saying what was expected.
picture::View parse_view(std::string_view text) {
  if (text == "iso") return picture::default_view({});
  if (text == "x") return picture::view_from(0, 0);
  if (text == "y") return picture::view_from(90, 0);
  if (text == "z") return picture::view_from(-90, 90);
  constexpr const char* kExpected =
      "iso, x, y, z, or AZIMUTH,ELEVATION with an elevation from -90 to 90 degrees";
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) fail_expected(kExpected);
  const double azimuth = parse_number(text.substr(0, comma));
  const double elevation = parse_number(text.substr(comma + 1));
  if (elevation < -90 || elevation > 90) fail_expected(kExpected);
  return picture::view_from(azimuth, elevation);
}

void add_subject(OptionSet& options, PictureRequest& request) {
  options.add({.name = "labels",
               .value = "LIST",
               .help = "labels to draw, as 1,Liver [all but the one around them]",
               .group = kShownGroup,
               .kind = ValueKind::kLabels,
               .flags = "--labels,--label",
               .assign = into(request.labels, parse_labels)});
  options.add({.name = "cut",
               .value = "x=SHARE",
               .help = "what is before a plane across x, y or z is taken away, as x=0.5",
               .group = kShownGroup,
               .assign = into(request.cut, parse_cut)});
  options.add({.name = "view",
               .value = "VIEW",
               .help = "iso, x, y, z, or AZIMUTH,ELEVATION in degrees [what suits the cut]",
               .group = kShownGroup,
               .assign = into(request.view, parse_view)});
}

void add_style(OptionSet& options, PictureRequest& request) {
  options.add({.name = "output",
               .value = "P.png",
               .help = "picture to write",
               .group = kOutputGroup,
               .flags = "-o,--output",
               .required = true,
               .assign = into(request.output)});
  options.add({.name = "pixels",
               .value = "WxH",
               .help = "width and height",
               .group = kOutputGroup,
               .fallback = "1200x900",
               .flags = "--pixels,--size",
               .assign = into(request.pixels, parse_pixels)});
  options.add({.name = "edges",
               .help = "edges of triangles; auto: fainter where they are small",
               .group = kOutputGroup,
               .fallback = "auto",
               .choices = {"auto", "on", "off"},
               .assign = into(request.lines, parse_lines)});
  options.add(
      {.name = "legend",
       .help = "the largest labels by name, a scale bar and directions, from 360x270 on",
       .group = kOutputGroup,
       .fallback = "on",
       .choices = {"on", "off"},
       .assign = [&request](const std::string& text) { request.has_legend = text == "on"; }});
  options.add(switch_of(request.transparent, {.name = "transparent",
                                              .help = "a transparent instead of a white background",
                                              .group = kOutputGroup}));
  add_force_option(options, request.force);
}

/// Adds every option of the command.  REQUIRES: request outlives options.
void add_picture_options(OptionSet& options, PictureRequest& request) {
  add_mesh_option(options, request.mesh, "mesh to draw");
  options.add({.name = "names",
               .value = "FILE",
               .help = "names and colours of labels [those in the mesh]",
               .group = kInputGroup,
               .assign = into(request.names)});
  add_subject(options, request);
  add_style(options, request);
}

void check(const PictureRequest& request) {
  if (request.output.extension() != ".png") {
    io::fail_usage("-o " + request.output.string() + ": pictures are written as .png");
  }
  FileNames files;
  files.read_mesh(request.mesh);
  files.read("--names", request.names);
  files.write("-o", request.output);
  files.require_apart();
  if (!request.force) files.require_own();
}

/// Returns by rank whether a label was asked for.
std::vector<bool> asked_labels(const io::LabelTable& table, const std::vector<RawLabel>& labels) {
  std::vector<bool> shown(table.size());
  for (const RawLabel label : labels) {
    if (!table.contains(label)) {
      io::fail_usage("--labels: the mesh has no label " + io::label_text(label, table.is_signed()) +
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
    std::cout << "left out    label "
              << report::label_text(table.raw(*around), table.is_signed(), names)
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
  if (!request.names.empty()) names = names.merged_with(names_in(request.names));
  std::vector<bool> shown =
      request.labels ? asked_labels(mesh.table(), *request.labels) : inner_labels(mesh, names);
  std::optional<picture::Legend> legend;
  if (request.has_legend) legend = picture::legend_of(mesh, shown, names);
  picture::MeshScene scene(mesh, std::move(shown), names);
  const picture::View view = request.view.value_or(picture::default_view(request.cut));
  if (request.cut) scene.cut(cut_plane(mesh.box(), *request.cut, view));
  return draw(scene,
              {.width = request.pixels[0],
               .height = request.pixels[1],
               .view = view,
               .lines = request.lines,
               .transparent = request.transparent,
               .legend = std::move(legend)},
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
