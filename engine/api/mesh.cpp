// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes to meshes, and meshes held against volumes.
#include <array>
#include <span>

#include "engine/api/guarded.h"
#include "engine/api/jobs.h"
#include "engine/api/types.h"
#include "engine/job/verify_job.h"
#include "engine/settings/together.h"
#include "engine/version.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/digest.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/open_mesh.h"
#include "io/remote/wait_stop.h"
#include "io/volume/open_volume.h"

namespace mwmesh {
namespace {

namespace io = mw::io;
namespace engine = mw::engine;

/// A caller's writer as a sink.
class WriterSink : public io::MeshSink {
 public:
  explicit WriterSink(MeshWriter& writer) : writer_(writer) {}

  void begin(const io::MeshHeader& header) override { writer_.begin(header.tets); }
  void write_vertices(std::span<const io::Position> positions) override {
    writer_.write_points(positions);
  }
  void write_tets(std::span<const io::TetRows> tets,
                  std::span<const mw::RawLabel> labels) override {
    writer_.write_tets(tets, labels);
  }
  void finish() override { writer_.finish(); }

 private:
  MeshWriter& writer_;
};

/// Returns a job with its images opened.
engine::MeshJob job_of(const Volume& volume, const Settings& settings, const Options& options,
                       const Hooks& hooks) {
  const std::function<void()> stop = mw::api::stop_function(hooks);
  const io::WaitStop waits(&stop);
  engine::MeshJob job =
      mw::api::mesh_job(VolumeAccess::labels(volume).info(), settings, options, hooks);
  for (engine::SampleImage& sample : job.samples) {
    sample.image =
        io::open_volume(mw::api::checked_path(sample.file, "sample"), {.dataset = sample.dataset});
  }
  return job;
}

std::string report_text(const mw::report::FinishedRun& run, const std::filesystem::path& path,
                        const engine::MeshJob& job) {
  std::string out;
  mw::report::append_run_report(run, path, mw::api::settings_json(job),
                                [&](std::string_view text) { out += text; });
  return out;
}

/// Does the job.  Where a run that is cancelled leaves work, the error says so: the engine says it
/// of its own errors alone.
mw::report::FinishedRun run(const io::LabelVolume& labels, engine::MeshJob job,
                            std::span<io::MeshSink* const> sinks) {
  bool is_kept = false;
  job.run.store.kept = [&] { is_kept = true; };
  try {
    return engine::mesh(labels, job, sinks);
  } catch (const Error& error) {
    if (!is_kept || error.kind() != ErrorKind::kCancelled) throw;
    throw Error(error.kind(),
                error.what() + ("; " + mw::api::library_words(engine::way_on(job.run))));
  }
}

/// Meshes into the sink.  Returns the report, in which the mesh is called `path`.
std::string run_into(io::MeshSink& sink, const std::filesystem::path& path, const Volume& volume,
                     const engine::MeshJob& job) {
  const io::LabelVolume& labels = VolumeAccess::labels(volume);
  if (!job.is_measured) {
    (void)run(labels, job, std::array{&sink});
    return {};
  }
  io::DigestSink digest(job.folder);
  mw::report::FinishedRun done = run(labels, job, std::array<io::MeshSink*, 2>{&digest, &sink});
  done.digest = digest.digest();
  return report_text(done, path, job);
}

Verdict library_verdict(const mw::report::Verdict& verdict) {
  Verdict out{.passed = verdict.audit.passed(), .checks = {}, .report = {}};
  for (const mw::audit::Check& check : verdict.audit.checks) {
    out.checks.push_back({.name = check.name, .passed = check.passed, .detail = check.detail});
  }
  out.report = mw::report::verdict_json(verdict).dump_indented();
  return out;
}

}  // namespace

const char* version() {
  return engine::version();
}

Mesh mesh(const Volume& volume, const Settings& settings, const Options& options,
          const Hooks& hooks) {
  return mw::api::guarded([&] {
    io::MeshDataSink sink;
    std::string report = run_into(sink, {}, volume, job_of(volume, settings, options, hooks));
    Mesh mesh = mw::api::library_mesh(std::move(sink.mesh()));
    mesh.report = std::move(report);
    return mesh;
  });
}

std::string mesh_to(MeshWriter& writer, const Volume& volume, const Settings& settings,
                    const Options& options, const Hooks& hooks) {
  return mw::api::guarded([&] {
    if (!options.sample.empty()) {
      throw mw::Error(mw::ErrorKind::kUsage,
                      "sample: a writer takes no values of tets; mesh() and mesh_to_file() have a "
                      "place for them");
    }
    WriterSink sink(writer);
    return run_into(sink, {}, volume, job_of(volume, settings, options, hooks));
  });
}

std::string mesh_to_file(const std::filesystem::path& path, const Volume& volume,
                         const Settings& settings, const Options& options, const Hooks& hooks,
                         const FileOptions& file) {
  return mw::api::guarded([&] {
    // What the format cannot have is said before images are opened.
    const bool has_values = !options.sample.empty() && file.values;
    if (has_values && file.materials.empty()) io::require_place_for_values(path);
    const bool has_wedges = !options.cohesive.empty();
    const io::Element element = io::parse_element(file.element);
    if (has_wedges) io::require_place_for_wedges(path, element);
    engine::MeshJob job = job_of(volume, settings, options, hooks);
    engine::check_together({.periodic = job.settings.periodic != 0,
                            .curves = element == io::Element::kCurvedTet10,
                            .doubles = job.connect.double_vertices(),
                            .pairs = !file.pairs.empty()});
    job.folder = mw::api::checked_path(path).parent_path();
    bool is_delivered = false;
    job.delivered = [&] { is_delivered = true; };
    const auto sink = mw::api::open_file(path, file, has_values, has_wedges);
    job.leaves_values_out = !file.values && file.materials.empty();
    try {
      return run_into(*sink, path, volume, job);
    } catch (const Error& error) {
      if (!is_delivered || error.kind() != ErrorKind::kCancelled) throw;
      throw Error(error.kind(), error.what() + ("; " + path.string() + " is complete"));
    }
  });
}

std::string mesh_to_file(const std::filesystem::path& path, const Volume& volume,
                         const Settings& settings, const Options& options, const Hooks& hooks,
                         std::string_view element) {
  return mesh_to_file(path, volume, settings, options, hooks,
                      FileOptions{.element = std::string(element)});
}

Verdict verify(const Mesh& mesh, const Volume& volume, const Options& options, const Hooks& hooks) {
  return mw::api::guarded([&] {
    const std::function<void()> stop = mw::api::stop_function(hooks);
    const io::LabelVolume& labels = VolumeAccess::labels(volume);
    const bool is_signed = io::has_signed_labels(labels.info());
    const engine::VerifyJob job{.volume = labels,
                                .steps = mw::api::input_steps(options, is_signed),
                                .choice = mw::api::label_choice(options),
                                .threads = mw::api::threads_of(options),
                                .memory = mw::api::memory_of(options),
                                .folder = mw::io::scratch_folder(),
                                .between = stop};
    return library_verdict(
        engine::verify(job, [&](mw::io::MeshSink& sink) { mw::api::deliver(mesh, sink); }));
  });
}

}  // namespace mwmesh
