// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The options of `mwmesh verify`.
#include "engine/cli/verify_request.h"

#include "engine/cli/resource_options.h"
#include "engine/cli/values.h"
#include "engine/system/machine_memory.h"
#include "io/mesh/open_mesh.h"
#include "kernels/audit/audit.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

constexpr const char* kNone = "none";
constexpr const char* kInterfaces = "interfaces";
constexpr const char* kVoxel = "voxel";

std::optional<double> parse_bound(const std::string& text) {
  if (text == kNone) return std::nullopt;
  const double bound = parse_number(text);
  if (bound >= 0) return bound;
  throw Error(ErrorKind::kUsage, "must not be negative; or none");
}

}  // namespace

void add_verify_options(OptionSet& options, VerifyRequest& request) {
  add_input_option(options, request.volume.path);
  options.add({.name = "mesh",
               .value = "MESH",
               .help = "mesh to check: " + io::read_mesh_extensions(),
               .flags = "MESH,--mesh",
               .assign = [&](const std::string& text) { request.mesh = text; }});
  add_volume_options(options, request.volume);
  add_choice_options(options, request.choice);
  options.add(
      {.name = "topology",
       .help = "what P1 looks at: labels, or interfaces and meetings of labels as well [what the "
               "run kept, else labels]",
       .choices = {"labels", kInterfaces},
       .assign = [&](const std::string& text) { request.asked.interfaces = text == kInterfaces; }});
  options.add({.name = "quality-floor",
               .value = "R",
               .help = "P3 fails for a tet below this radius ratio [the run's, else " +
                       format_number(kOtherPromises.quality_floor) + "]",
               .kind = ValueKind::kNumber,
               .assign = [&](const std::string& text) {
                 request.asked.quality_floor = parse_number(text);
               }});
  options.add(
      {.name = "max-distance",
       .value = "D",
       .help = "P4 fails above this many voxels (see --surface) between label boundaries, or none "
               "[the run's, else " +
               format_number(*kOtherPromises.max_distance) + "]",
       .kind = ValueKind::kNumberOrNone,
       .assign = [&](const std::string& text) { request.asked.max_distance = parse_bound(text); }});
  options.add({.name = "surface",
               .help = "how the mesh was made, hence what distances count in: smooth, voxels of "
                       "the lattice where thick slices are cut into layers; voxel, the input's "
                       "[the run's, else smooth]",
               .choices = {"smooth", kVoxel},
               .assign = [&](const std::string& text) { request.asked.smooth = text != kVoxel; }});
  options.add({.name = "max-volume-error",
               .value = "E",
               .help =
                   "P8 fails when a label of 1000 voxels or more is off by a larger share of its "
                   "volume (of one with more than 0.4 faces a voxel, 2.5 times that share for "
                   "each face), or none [none where the mesh's run did not promise it, else 0.05]",
               .kind = ValueKind::kNumberOrNone,
               .assign = [&](const std::string& text) {
                 request.asked.max_volume_error = parse_bound(text);
               }});
  add_resource_options(options, request.threads, request.memory,
                       "what lists and buffers may take together, beside a tile a thread");
  options.add({.name = "report",
               .value = "FILE.json",
               .help = "writes the result as JSON",
               .assign = [&](const std::string& text) { request.report = text; }});
}

void check_verify_request(VerifyRequest& request) {
  require_path(request.mesh, "MESH");
  engine::check_choice(request.choice);
  if (request.asked.interfaces.value_or(false) &&
      (request.choice.labels || request.choice.background)) {
    throw Error(ErrorKind::kUsage,
                "--topology interfaces: is for meshes of all labels, without --labels and "
                "--background");
  }
  if (!request.memory) request.memory = engine::default_memory_budget();
  request.volume.cache_bytes = cache_bytes(*request.memory);
}

}  // namespace mw::cli
