// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What mwmesh surface is asked for.
#include "engine/cli/surface_request.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "engine/cli/surface_output.h"
#include "engine/cli/values.h"
#include "io/surface/open_surface.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorKind::kUsage, message);
}

/// Runs parse(text); its errors name the option.
template <class Parse>
auto parsed(const char* option, const std::string& text, Parse parse) {
  try {
    return parse(text);
  } catch (const Error& error) {
    fail(std::string(option) + " " + text + ": " + error.what());
  }
}

double nm_of(const std::string& unit) {
  const std::map<std::string, double> units{{"nm", 1}, {"um", 1e3}, {"mm", 1e6}, {"m", 1e9}};
  const auto found = units.find(unit);
  if (found == units.end()) fail("--unit " + unit + ": expected nm, um, mm or m");
  return found->second;
}

std::vector<RawLabel> parse_label_list(const std::string& text) {
  std::vector<RawLabel> labels;
  for (const RawLabel label : parsed("--label", text, parse_labels)) {
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
  }
  return labels;
}

std::array<RawLabel, 2> parse_pair(const std::string& text) {
  const std::vector<RawLabel> labels = parsed("--pair", text, parse_labels);
  if (labels.size() != 2 || labels[0] == labels[1]) {
    fail("--pair " + text + ": expected two labels, as --pair 1,2");
  }
  return {labels[0], labels[1]};
}

/// By --format, else the extension; a path without one is a folder.
std::string format_of(const SurfaceFlags& flags) {
  const std::string extension = std::filesystem::path(flags.output).extension().string();
  if (flags.format.empty()) {
    if (extension.empty()) return "precomputed";
    if (io::is_surface_path(flags.output)) return extension.substr(1);
    fail("-o " + flags.output + ": extension '" + extension +
         "' is no surface format known here; supported are " + io::surface_extensions() +
         ", and a folder of precomputed meshes, which needs --format precomputed or draco if its "
         "name has an extension");
  }
  if (is_folder_format(flags.format)) return flags.format;
  if (!io::is_surface_path("x." + flags.format)) {
    fail("--format " + flags.format + ": expected stl, ply, precomputed or draco");
  }
  if (io::is_surface_path(flags.output) && extension != "." + flags.format) {
    fail("--format " + flags.format + " and -o " + flags.output + " contradict each other");
  }
  return flags.format;
}

bool names_each(const SurfaceFlags& flags) {
  return flags.each || flags.output.find(kLabelPlaceholder) != std::string::npos;
}

/// Where each label goes: as it is with `{label}` in it, else into a folder.
std::string pattern_of(const SurfaceFlags& flags, const std::string& format) {
  if (flags.output.find(kLabelPlaceholder) != std::string::npos) return flags.output;
  if (io::is_surface_path(flags.output)) {
    fail("-o " + flags.output + ": with --each the name needs " + kLabelPlaceholder +
         " where the label goes, as -o 'parts/" + kLabelPlaceholder + "." + format +
         "'; or give a folder and --format " + format);
  }
  return (std::filesystem::path(flags.output) / (std::string(kLabelPlaceholder) + "." + format))
      .string();
}

void set_target(const SurfaceFlags& flags, SurfaceRequest& request) {
  const std::string format = format_of(flags);
  if (is_folder_format(format)) {
    if (request.pair) fail("--pair: precomputed meshes are surfaces of labels; write .ply or .stl");
    if (flags.output.find(kLabelPlaceholder) != std::string::npos) {
      fail("-o " + flags.output + ": one folder of precomputed meshes holds all labels");
    }
    request.target = SurfaceTarget::kFolder;
    if (format == "draco") request.folder.kind = io::FragmentKind::kDraco;
    if (!flags.unit.empty()) request.folder.nm_per_unit = nm_of(flags.unit);
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

}  // namespace

SurfaceRequest parse_surface_request(const SurfaceFlags& flags) {
  SurfaceRequest request{.mesh = flags.mesh,
                         .output = flags.output,
                         .folder = {},
                         .labels = {},
                         .pair = {},
                         .manifold = flags.manifold,
                         .closed = !flags.open};
  if (!flags.pair.empty() && (!flags.label.empty() || names_each(flags))) {
    fail(std::string("--pair: not together with --label, --each or ") + kLabelPlaceholder);
  }
  if (!flags.label.empty()) request.labels = parse_label_list(flags.label);
  if (!flags.pair.empty()) request.pair = parse_pair(flags.pair);
  set_target(flags, request);
  return request;
}

}  // namespace mw::cli
