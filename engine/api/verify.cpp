// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes held against volumes.

#include "engine/api/guarded.h"
#include "engine/api/jobs.h"
#include "engine/api/meshes.h"
#include "engine/api/volume_access.h"
#include "engine/job/verify_job.h"
#include "io/file/scratch/scratch_file.h"

namespace mwmesh {
namespace {

namespace engine = mw::engine;

Verdict library_verdict(const mw::report::Verdict& verdict) {
  Verdict out{.passed = verdict.audit.passed(), .checks = {}, .report = {}};
  for (const mw::audit::Check& check : verdict.audit.checks) {
    out.checks.push_back({.name = check.name, .passed = check.passed, .detail = check.detail});
  }
  out.report = mw::report::verdict_json(verdict).dump_indented();
  return out;
}

}  // namespace

Verdict verify(const Mesh& mesh, const Volume& volume, const Options& options, const Hooks& hooks) {
  return mw::api::guarded([&] {
    const std::function<void()> stop = mw::api::stop_function(hooks);
    const engine::VerifyJob job{.volume = VolumeAccess::labels(volume),
                                .steps = mw::api::input_steps(options),
                                .choice = mw::api::label_choice(options),
                                .threads = options.threads,
                                .memory = mw::api::memory_of(options),
                                .folder = mw::io::scratch_folder(),
                                .between = stop};
    return library_verdict(
        engine::verify(job, [&](mw::io::MeshSink& sink) { mw::api::deliver(mesh, sink); }));
  });
}

}  // namespace mwmesh
