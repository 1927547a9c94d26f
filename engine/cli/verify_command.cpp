// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh verify: promises P1 to P4 and P8 of a finished mesh, independently of how it was made.
#include <CLI/CLI.hpp>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/mesh_facts.h"
#include "engine/cli/verdict.h"
#include "engine/labels/label_scan.h"
#include "engine/march/march.h"
#include "io/file/nameless_file.h"
#include "io/mesh/open_mesh.h"

namespace mw::cli {
namespace {

struct VerifyJob {
  OptionSet options;
  VerifyRequest request;
};

Verdict judge(const VerifyRequest& request) {
  const std::unique_ptr<io::LabelVolume> opened = open(request.volume);
  const io::PreparedInput input(*opened, request.volume.steps,
                                io::SpeckLimits::of_budget(*request.memory));
  const io::LabelVolume& volume = input.volume();
  const io::VolumeInfo& info = volume.info();
  Verdict verdict{.specks = input.specks(),
                  .table = engine::collect_labels(volume, request.threads),
                  .names = info.names};
  const std::filesystem::path folder = io::scratch_folder();
  engine::MeshTiles mesh(info, verdict.table, {folder, *request.memory / 8});
  io::copy_mesh(request.mesh, mesh);
  verdict.bounds = bounds_of(request, mesh.header().record);
  engine::VerifyTask task{.options = audit_options(verdict.bounds.promises, info.space),
                          .threads = engine::thread_count(request.threads),
                          .memory_bytes = *request.memory / 2,
                          .folder = folder};
  task.options.max_volume_error = request.max_volume_error;
  task.options.kept = kept_labels(request.choice, verdict.table);
  verdict.layers = task.options.layers;
  verdict.audit = engine::verify_mesh(io::DenseVolume(volume, verdict.table), mesh, task);
  return verdict;
}

int run_verify(VerifyJob& job) {
  job.options.resolve();
  check_verify_request(job.request);
  const ResourceMeter meter;
  std::optional<io::AtomicFile> report;
  if (!job.request.report.empty()) report.emplace(job.request.report);
  const Verdict verdict = judge(job.request);
  print_verdict(verdict);
  if (report) write_json(*report, verify_report(job.options.json(), verdict, meter.read()));
  return verdict.audit.passed() ? kExitDone : kExitCheckFailed;
}

}  // namespace

void add_verify_command(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand("verify", "checks a mesh against its volume");
  const auto job = std::make_shared<VerifyJob>();
  add_verify_options(job->options, job->request);
  job->options.add_flags(*command);
  command->callback([job, &chosen] { chosen = [job] { return run_verify(*job); }; });
}

}  // namespace mw::cli
