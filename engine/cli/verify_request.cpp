// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The options of `mwmesh verify`.
#include "engine/cli/verify_request.h"

#include "engine/cli/options/file_names.h"
#include "engine/cli/options/shared_options.h"
#include "engine/cli/options/values.h"
#include "engine/system/memory.h"
#include "io/file/errors.h"
#include "kernels/audit/audit.h"

namespace mw::cli {
namespace {

constexpr const char* kNone = "none";
constexpr const char* kInterfaces = "interfaces";

std::optional<double> parse_bound(const std::string& text) {
  if (text == kNone) return std::nullopt;
  const double bound = parse_number(text);
  if (bound >= 0) return bound;
  io::fail_usage("must not be negative; or none");
}

void add_bounds(OptionSet& options, VerifyRequest& request) {
  options.add({.name = "max-distance",
               .value = "D|none",
               .help = "P4: voxels at most between interfaces [the run's, else " +
                       format_number(*kOtherPromises.max_distance) + "]",
               .group = kShapeGroup,
               .kind = ValueKind::kNumberOrNone,
               .assign = into(request.asked.max_distance, parse_bound)});
  options.add({.name = "quality-floor",
               .value = "R",
               .help = "P3: no tet below this radius ratio [the run's, else " +
                       format_number(kOtherPromises.quality_floor) + "]",
               .group = kShapeGroup,
               .kind = ValueKind::kNumber,
               .assign = into(request.asked.quality_floor, parse_number)});
  options.add({.name = "max-volume-error",
               .value = "E|none",
               .help = "P8: share that large labels may be off by [0.05, where promised]",
               .group = kShapeGroup,
               .kind = ValueKind::kNumberOrNone,
               .assign = into(request.asked.max_volume_error, parse_bound)});
  options.add({.name = "topology",
               .help = "P1: of labels, or of interfaces, too [what the run kept]",
               .group = kShapeGroup,
               .choices = {"labels", kInterfaces},
               .assign = into(request.asked.interfaces,
                              [](const std::string& text) { return text == kInterfaces; })});
}

}  // namespace

void add_verify_options(OptionSet& options, VerifyRequest& request) {
  add_input_option(options, request.volume.path);
  add_mesh_option(options, request.mesh, "mesh to check");
  add_volume_options(options, request.volume);
  add_choice_options(options, request.choice);
  add_step_options(options, request.volume);
  add_bounds(options, request);
  add_resource_options(options, request.threads, request.memory, "bound on buffers");
  options.add({.name = "report",
               .value = "FILE.json",
               .help = "writes the result as JSON",
               .group = kOutputGroup,
               .assign = into(request.report)});
}

void check_verify_request(VerifyRequest& request) {
  engine::check_choice(request.choice);
  if (request.asked.interfaces.value_or(false) &&
      (request.choice.labels || request.choice.background)) {
    io::fail_usage(
        "--topology interfaces: is for meshes of all labels, without --labels and "
        "--background");
  }
  FileNames files;
  files.read_volume(request.volume);
  files.read_mesh(request.mesh);
  files.write("--report", request.report);
  files.require_apart();
  if (!request.memory) request.memory = engine::default_memory_budget();
  request.volume.open.cache_bytes = cache_bytes(*request.memory);
}

}  // namespace mw::cli
