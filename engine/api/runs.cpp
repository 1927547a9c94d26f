// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes to meshes, and meshes held against volumes.
#include <array>

#include "engine/api/asked.h"
#include "engine/api/errors.h"
#include "engine/api/mesh_file.h"
#include "engine/api/watch.h"
#include "engine/job/verify_job.h"
#include "engine/request/values.h"
#include "engine/settings/setting_table.h"
#include "engine/version.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/digest.h"
#include "io/remote/wait_stop.h"
#include "io/volume/decode.h"

namespace mw::api {
namespace {

/// Returns settings and options as reports tell them.
io::Json settings_json(const engine::MeshJob& job) {
  io::Json out = io::Json::object();
  for (const engine::Setting& setting : engine::setting_table()) {
    out[request::key_of(setting.name)] =
        request::json_of_text(setting.kind, setting.text(job.settings));
  }
  out["threads"] = job.run.threads;
  out["memory"] = job.run.store.memory;
  out["workdir"] = job.run.store.workdir.string();
  return out;
}

/// A call that meshes a volume.
class Run {
 public:
  Run(const mw_volume& volume, const mw_options* options, const mw_hooks* hooks)
      : volume_(*volume.labels), asked_(options), watch_(hooks) {}

  /// Settles what is asked before the mesh goes into memory, or into a file of this name.
  void settle(const std::filesystem::path& output);
  [[nodiscard]] request::MeshRequest& request() { return asked_.request(); }
  /// Meshes into the sink.  Returns the report, empty if none was asked for.
  [[nodiscard]] std::string into(io::MeshSink& sink);

 private:
  [[nodiscard]] engine::MeshJob job();
  /// Does the job.  Where a run that is cancelled leaves work, the error says so: the engine says
  /// it of its own errors alone.
  [[nodiscard]] report::FinishedRun mesh(engine::MeshJob job,
                                         std::span<io::MeshSink* const> sinks) const;

  const io::LabelVolume& volume_;
  std::filesystem::path output_;
  Asked asked_;
  Watch watch_;
};

void Run::settle(const std::filesystem::path& output) {
  request::MeshRequest& request = asked_.request();
  output_ = request.output = output;
  asked_.options().resolve_names([&] { return volume_.info().names; });
  request::settle_mesh_request(request);
  const engine::RunHooks& run = request.job.run;
  if (run.store.resume && run.store.workdir.empty() && run.keep.folder.empty()) {
    io::fail_usage("--resume: needs the --workdir or the --keep of the run that ended early");
  }
  request::check_mesh_request(request);
  request::settle_changed(request, volume_.info());
}

engine::MeshJob Run::job() {
  const request::MeshRequest& request = asked_.request();
  engine::MeshJob job = request.job;
  job.stop = watch_.stop();
  job.warn = watch_.warn();
  job.run.progress = watch_.progress();
  job.is_measured = job.finds_parts = job.finds_volumes = request.is_measured;
  const bool tells_edit = !request.from.empty() && request.is_measured;
  job.delta = tells_edit ? engine::Delta::kIfKnown : engine::Delta::kNo;
  job.folder = request.output.empty() ? io::scratch_folder() : request.output.parent_path();
  job.leaves_values_out = !request.write_values && !request.extras.materials;
  const io::WaitStop waits(&job.stop);
  request::open_images(request, job);
  return job;
}

report::FinishedRun Run::mesh(engine::MeshJob job, std::span<io::MeshSink* const> sinks) const {
  bool is_kept = false, is_delivered = false;
  job.run.store.kept = [&] { is_kept = true; };
  job.delivered = [&] { is_delivered = true; };
  const std::string output = output_.string();
  try {
    return engine::mesh(volume_, job, sinks);
  } catch (const Cancelled& end) {
    std::string text = end.what();
    if (is_kept) text += "; " + in_words(engine::way_on(job.run));
    if (is_delivered && !output.empty()) text += "; " + output + " is complete";
    throw Cancelled(text);
  }
}

std::string Run::into(io::MeshSink& sink) {
  const engine::MeshJob job = this->job();
  if (!job.is_measured) {
    (void)mesh(job, std::array{&sink});
    return {};
  }
  io::DigestSink digest(job.folder);
  report::FinishedRun done = mesh(job, std::array<io::MeshSink*, 2>{&digest, &sink});
  done.digest = digest.digest();
  std::string out;
  report::append_run_report(done, output_, settings_json(job),
                            [&](std::string_view text) { out += text; });
  return out;
}

std::string mesh_to_file(const char* path, Run& run) {
  run.settle(path);
  const request::MeshRequest& request = run.request();
  const bool has_values = !request.job.samples.empty() && request.write_values;
  return run.into(*open_file(path, request, has_values));
}

report::Verdict verdict_of(const mw_mesh& mesh, const mw_volume& volume, const mw_options* options,
                           const mw_hooks* hooks) {
  Asked asked(options);
  asked.options().resolve_names([&] { return volume.labels->info().names; });
  request::MeshRequest& request = asked.request();
  request::settle_mesh_request(request);
  const engine::VerifyJob job{.volume = *volume.labels,
                              .steps = request.volume.steps,
                              .choice = request.job.choice,
                              .threads = request.job.run.threads,
                              .memory = request.job.run.store.memory,
                              .folder = io::scratch_folder(),
                              .between = Watch(hooks).stop()};
  return engine::verify(job, [&](io::MeshSink& sink) { deliver(mesh, sink); });
}

std::string text_of_verdict(const report::Verdict& verdict) {
  io::Json out = report::verdict_json(verdict);
  io::Json checks = io::Json::array();
  for (const audit::Check& check : verdict.audit.checks) {
    checks.push_back({{"name", check.name}, {"passed", check.passed}, {"detail", check.detail}});
  }
  out["passed"] = verdict.audit.passed();
  out["checks"] = std::move(checks);
  return out.dump_indented();
}

}  // namespace
}  // namespace mw::api

namespace api = mw::api;

const char* mw_version() {
  return mw::engine::version();
}

mw_mesh* mw_make_mesh(const mw_volume* volume, const mw_options* options, const mw_hooks* hooks,
                      mw_error** error) {
  return api::made(error, [&] {
    api::require(volume, "volume");
    api::Run run(*volume, options, hooks);
    run.settle({});
    mw::io::MeshDataSink sink;
    auto mesh = std::make_unique<mw_mesh>();
    mesh->report = run.into(sink);
    mesh->data = std::move(sink.mesh());
    mesh->settle();
    return mesh.release();
  });
}

mw_status mw_mesh_to_file(const char* path, const mw_volume* volume, const mw_options* options,
                          const mw_hooks* hooks, char** report, mw_error** error) {
  return api::tried(error, [&] {
    api::require(path, "path");
    api::require(volume, "volume");
    api::Run run(*volume, options, hooks);
    const std::string told = api::mesh_to_file(path, run);
    if (report != nullptr) *report = told.empty() ? nullptr : api::text_of(told);
  });
}

char* mw_verify(const mw_mesh* mesh, const mw_volume* volume, const mw_options* options,
                const mw_hooks* hooks, int* passed, mw_error** error) {
  return api::made(error, [&] {
    api::require(mesh, "mesh");
    api::require(volume, "volume");
    const mw::report::Verdict verdict = api::verdict_of(*mesh, *volume, options, hooks);
    char* const text = api::text_of(api::text_of_verdict(verdict));
    if (passed != nullptr) *passed = verdict.audit.passed() ? 1 : 0;
    return text;
  });
}
