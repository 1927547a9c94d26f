// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The options of mwmesh surface.
#include "engine/cli/surface/surface_request.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>

#include "engine/cli/options/mesh_options.h"
#include "engine/cli/requests.h"
#include "engine/cli/surface/surface_volume.h"
#include "io/file/errors.h"
#include "io/surface/open_surface.h"

namespace mw::cli {
namespace {

constexpr const char* kSurfaceGroup = "Which surfaces";

[[noreturn]] void fail(const std::string& message) {
  io::fail_usage(message);
}

std::vector<RawLabel> parse_label_list(const std::string& text) {
  std::vector<RawLabel> labels;
  for (const RawLabel label : parse_labels(text)) {
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
  }
  return labels;
}

std::array<RawLabel, 2> parse_pair(const std::string& text) {
  const std::vector<RawLabel> labels = parse_labels(text);
  if (labels.size() != 2 || labels[0] == labels[1]) fail("expected two labels, as --pair 1,2");
  return {labels[0], labels[1]};
}

/// Returns the format by --format, else by the extension; a path without one is a folder, of .stl
/// files with --each.
std::string format_of(const SurfaceFlags& flags) {
  const std::string extension = std::filesystem::path(flags.output).extension().string();
  if (flags.format.empty()) {
    if (extension.empty()) return flags.each ? "stl" : "precomputed";
    if (io::is_surface_path(flags.output)) return extension.substr(1);
    fail("-o " + flags.output + ": extension '" + extension +
         "' is no surface format known here; supported are " + io::surface_extensions() +
         ", and a folder of precomputed meshes, which needs --format precomputed or draco if its "
         "name has an extension");
  }
  if (is_folder_format(flags.format)) return flags.format;
  if (!io::is_surface_path("x." + flags.format)) {
    fail("--format " + flags.format + ": expected precomputed, draco, or one of " +
         io::surface_extensions() + " without the dot");
  }
  if (io::is_surface_path(flags.output) && extension != "." + flags.format) {
    fail("--format " + flags.format + " and -o " + flags.output + " contradict each other");
  }
  return flags.format;
}

bool has_placeholder(const SurfaceFlags& flags) {
  return flags.output.find(kLabelPlaceholder) != std::string::npos ||
         flags.output.find(kNamePlaceholder) != std::string::npos;
}

bool names_each(const SurfaceFlags& flags) {
  return flags.each || has_placeholder(flags);
}

/// Returns the pattern of file names: the output if it has a placeholder, else files in that
/// folder.
std::string pattern_of(const SurfaceFlags& flags, const std::string& format) {
  if (has_placeholder(flags)) return flags.output;
  if (io::is_surface_path(flags.output)) {
    fail(io::text("-o ", flags.output, ": with --each the name needs ", kLabelPlaceholder, " or ",
                  kNamePlaceholder, " where the label goes, as -o 'parts/", kLabelPlaceholder, ".",
                  format, "'; or give a folder and --format ", format));
  }
  return (std::filesystem::path(flags.output) / (std::string(kLabelPlaceholder) + "." + format))
      .string();
}

void set_target(const SurfaceFlags& flags, SurfaceRequest& request) {
  const std::string format = format_of(flags);
  if (is_folder_format(format)) {
    if (request.pair) fail("--pair: precomputed meshes are surfaces of labels; write .ply or .stl");
    if (has_placeholder(flags)) {
      fail("-o " + flags.output + ": one folder of precomputed meshes holds all labels");
    }
    if (flags.shift) fail("--shift: precomputed meshes lie where their volume does");
    request.target = SurfaceTarget::kFolder;
    if (format == "draco") request.folder.kind = io::FragmentKind::kDraco;
    request.folder.closed = request.closed;
    if (!flags.unit.empty() && !io::nm_in(flags.unit)) {
      fail("--unit " + flags.unit + ": expected nm, um, mm or m");
    }
    request.unit = flags.unit;
    return;
  }
  if (!flags.unit.empty()) fail("--unit: only precomputed meshes have a unit, nm");
  if (names_each(flags)) {
    request.target = SurfaceTarget::kEachFile;
    request.output = pattern_of(flags, format);
  } else if (!io::is_surface_path(flags.output)) {
    fail("-o " + flags.output + ": the name needs the extension ." + format);
  }
}

/// Surfaces of labels are parted where their format is one for printers, others if asked for.
/// Readers of a format that joins equal places would undo it unless the places differ, too.
void set_touching(const SurfaceFlags& flags, SurfaceRequest& request) {
  const bool is_file = request.target != SurfaceTarget::kFolder;
  const io::SurfaceTraits traits =
      is_file ? io::surface_traits(request.output) : io::SurfaceTraits{};
  const bool of_labels = request.target == SurfaceTarget::kEachFile || !request.labels.empty();
  request.manifold = flags.manifold.value_or(traits.is_printed && of_labels);
  request.joined = traits.joined;
  if (!request.manifold) return;
  request.touching =
      traits.joined == io::Joined::kByPlace ? io::Touching::kApart : io::Touching::kDoubled;
}

void add_output_options(OptionSet& options, SurfaceFlags& flags) {
  options.add({.name = "output",
               .value = "OUTPUT",
               .help = "file: " + io::surface_extensions() + "; or a folder of precomputed meshes",
               .group = kOutputGroup,
               .flags = "-o,--output",
               .required = true,
               .assign = into(flags.output)});
  options.add(switch_of(flags.each,
                        {.name = "each",
                         .help = "a file for each label, as -o 'parts/{label}.stl' or '{name}.stl'",
                         .group = kOutputGroup}));
  options.add({.name = "format",
               .value = "FORMAT",
               .help = "precomputed, draco, or an extension of -o [that of -o; --each: stl]",
               .group = kOutputGroup,
               .assign = into(flags.format)});
  options.add({.name = "unit",
               .value = "UNIT",
               .help = "nm, um, mm or m: the mesh's, for precomputed ones [its own, or nm]",
               .group = kOutputGroup,
               .assign = into(flags.unit)});
  options.add({.name = "shift",
               .value = "X,Y,Z",
               .help = "a place that becomes 0,0,0; the file says it",
               .group = kOutputGroup,
               .assign = into(flags.shift, parse_numbers)});
  add_force_option(options, flags.force);
}

}  // namespace

void add_surface_options(OptionSet& options, SurfaceFlags& flags) {
  options.add({.name = "mesh",
               .value = "INPUT",
               .help = "mesh, or volume to mesh for this",
               .group = kInputGroup,
               .flags = "INPUT,--mesh",
               .required = true,
               .assign = into(flags.input)});
  options.add({.name = "labels",
               .value = "LIST",
               .help = "the surface of each of these, with what lies on the box",
               .group = kSurfaceGroup,
               .kind = ValueKind::kLabels,
               .flags = "--labels,--label",
               .assign = into(flags.labels, parse_label_list)});
  options.add({.name = "pair",
               .value = "A,B",
               .help = "the interface of these two",
               .group = kSurfaceGroup,
               .kind = ValueKind::kLabels,
               .assign = into(flags.pair, parse_pair)});
  options.add(switch_of(flags.open, {.name = "open",
                                     .help = "without what lies on the sides of the box",
                                     .group = kSurfaceGroup}));
  options.add({.name = "manifold",
               .help = "parts surfaces that touch themselves; --no-manifold [.stl, .obj]",
               .group = kSurfaceGroup,
               .kind = ValueKind::kSwitch,
               .flags = "--manifold,!--no-manifold",
               .assign = into(flags.manifold, parse_switch)});
  add_output_options(options, flags);
  add_volume_route(options, flags.meshing);
}

SurfaceRequest parse_surface_request(const SurfaceFlags& flags) {
  SurfaceRequest request{.input = flags.input.string(),
                         .output = flags.output,
                         .folder = {},
                         .labels = flags.labels,
                         .pair = flags.pair,
                         .shift = flags.shift.value_or(io::Position{}),
                         .force = flags.force,
                         .closed = !flags.open};
  if (flags.pair && (!flags.labels.empty() || names_each(flags))) {
    fail(io::text("--pair: not together with --labels, --each or ", kLabelPlaceholder));
  }
  set_target(flags, request);
  set_touching(flags, request);
  return request;
}

}  // namespace mw::cli
