// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh verify: promises P1 to P4 and P8 of a finished mesh, independently of how it was made.
#include <CLI/CLI.hpp>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/verify_request.h"
#include "engine/job/verify_job.h"
#include "engine/report/mesh_facts.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/open_mesh.h"

namespace mw::cli {
namespace {

struct VerifyCommand {
  OptionSet options;
  VerifyRequest request;
};

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

int run_verify(VerifyCommand& job) {
  job.options.resolve();
  check_verify_request(job.request);
  const report::ResourceMeter meter;
  std::optional<io::AtomicFile> file;
  if (!job.request.report.empty()) file.emplace(job.request.report);
  const report::Verdict verdict = judge(job.request);
  report::print_verdict(verdict);
  if (file)
    report::write_json(*file, report::verify_report(job.options.json(), verdict, meter.read()));
  return verdict.audit.passed() ? kExitDone : kExitCheckFailed;
}

}  // namespace

void add_verify_command(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand("verify", "checks a mesh against its volume");
  const auto job = std::make_shared<VerifyCommand>();
  add_verify_options(job->options, job->request);
  job->options.add_flags(*command);
  command->callback([job, &chosen] { chosen = [job] { return run_verify(*job); }; });
}

}  // namespace mw::cli
