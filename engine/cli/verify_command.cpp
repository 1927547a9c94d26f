// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh verify: promises P1 to P4 and P8 of a finished mesh, independently of how it was made.
#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/options/shared_options.h"
#include "engine/cli/verify_request.h"
#include "engine/job/verify_job.h"
#include "engine/report/mesh_facts.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/open_mesh.h"

namespace mw::cli {
namespace {

report::Verdict judge(const VerifyRequest& request) {
  const std::unique_ptr<io::LabelVolume> opened = open(request.volume);
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
  const report::ResourceMeter meter;
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

}  // namespace mw::cli
