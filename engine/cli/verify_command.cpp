// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh verify and mwmesh digest: promises P1 to P4 and P8 of a finished mesh, independently of
// how it was made, and its digest (P5).
#include <iostream>
#include <optional>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/log.h"
#include "engine/cli/options/file_names.h"
#include "engine/cli/options/mesh_options.h"
#include "engine/cli/requests.h"
#include "engine/job/verify_job.h"
#include "engine/output/label_selection.h"
#include "engine/report/mesh_facts.h"
#include "engine/system/memory.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"
#include "kernels/audit/audit.h"

namespace mw::cli {
namespace {

/// What `mwmesh verify` is asked to do.
struct VerifyRequest {
  VolumeRequest volume;
  engine::LabelChoice choice;
  std::filesystem::path mesh;
  std::filesystem::path report;
  engine::AskedBounds asked;
  int threads = 0;                      ///< 0: all cores
  std::optional<std::uint64_t> memory;  ///< bytes; after check_verify_request() never empty
  bool force = false;                   ///< whether it may replace a file of others
};

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
                       format_number(*report::kOtherPromises.max_distance) + "]",
               .group = kShapeGroup,
               .kind = ValueKind::kNumberOrNone,
               .assign = into(request.asked.max_distance, parse_bound)});
  options.add({.name = "quality-floor",
               .value = "R",
               .help = "P3: no tet below this radius ratio [the run's, else " +
                       format_number(report::kOtherPromises.quality_floor) + "]",
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

/// Adds every option of the subcommand.  REQUIRES: request outlives options.
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
  add_force_option(options, request.force);
}

/// Fills in what follows from other values.
/// ERRORS: mw::Error(kUsage) when values contradict each other, or names of files collide.
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
  if (!request.force) files.require_own();
  if (!request.memory) request.memory = engine::default_memory_budget();
  request.volume.open.cache_bytes = cache_bytes(*request.memory);
}

report::Verdict judge(const VerifyRequest& request) {
  const std::unique_ptr<io::LabelVolume> opened = open(request.volume, log_warning);
  const engine::VerifyJob job{.volume = *opened,
                              .steps = request.volume.steps,
                              .choice = request.choice,
                              .asked = request.asked,
                              .threads = request.threads,
                              .memory = *request.memory,
                              .folder = io::scratch_folder()};
  return engine::verify(job, [&](io::MeshSink& sink) { io::copy_mesh(request.mesh, sink); });
}

int run_verify(VerifyRequest& request, const OptionSet& options) {
  refuse_idle_cache(options, request.volume);
  check_verify_request(request);
  const engine::ResourceMeter meter;
  std::optional<io::AtomicFile> file;
  if (!request.report.empty()) file.emplace(request.report);
  const report::Verdict verdict = judge(request);
  report::print_verdict(verdict);
  if (file) report::write_json(*file, report::verify_report(options.json(), verdict, meter.read()));
  return verdict.audit.passed() ? kExitDone : kExitCheckFailed;
}

}  // namespace

Command verify_command() {
  const auto request = std::make_shared<VerifyRequest>();
  Command command{
      .name = "verify",
      .about = "checks a mesh against its volume",
      .options = {},
      .run = [request](const OptionSet& options) { return run_verify(*request, options); },
      .note = volume_note() + mesh_note(),
      .names = [request] { return names_of(request->volume); }};
  add_verify_options(command.options, *request);
  return command;
}

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
