// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The options of `mwmesh mesh`.
#include "engine/cli/mesh_request.h"

#include <algorithm>

#include "engine/cli/mesh_paths.h"
#include "engine/cli/resource_options.h"
#include "engine/cli/setting_options.h"
#include "engine/cli/size_options.h"
#include "engine/cli/values.h"
#include "engine/codt/worker_pool.h"
#include "engine/system/machine_memory.h"
#include "io/mesh/open_mesh.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

void add_output_option(OptionSet& options, MeshRequest& request) {
  options.add({.name = "output",
               .value = "OUTPUT",
               .help = "mesh to write: " + io::mesh_extensions(),
               .flags = "-o,--output",
               .assign = [&](const std::string& text) { request.output = text; }});
  options.add({.name = "element",
               .value = "ELEMENT",
               .help = "nodes of a tet in OUTPUT: tet4; tet10, with the middles of its edges",
               .fallback = "tet4",
               .choices = {"tet4", "tet10"},
               .assign = [&](const std::string& text) { request.element = parse_element(text); }});
}

std::chrono::milliseconds parse_delay(const std::string& text) {
  constexpr double kMaxSeconds = 1e6;
  const double seconds = parse_number(text);
  if (seconds < 0 || seconds > kMaxSeconds) {
    throw Error(ErrorKind::kUsage, "expected seconds from 0 to 1000000");
  }
  return std::chrono::milliseconds(static_cast<std::int64_t>(1000 * seconds));
}

void add_run_options(OptionSet& options, MeshRequest& request) {
  add_resource_options(options, request.job.run.threads, request.memory,
                       "hard budget for the process");
  options.add({.name = "workdir",
               .value = "DIR",
               .help = "folder of the block store and journal, removed after success [OUTPUT.work]",
               .assign = [&](const std::string& text) { request.job.run.store.workdir = text; }});
  options.add({.name = "resume",
               .help = "go on from the work that a run left when it was killed or interrupted",
               .kind = ValueKind::kSwitch,
               .fallback = "false",
               .assign = [&](const std::string& text) {
                 request.job.run.store.resume = parse_switch(text);
               }});
  options.add({.name = "save-every",
               .value = "SECONDS",
               .help = "how often finished work becomes durable; a kill loses at most so much",
               .kind = ValueKind::kNumber,
               .fallback = "10",
               .assign = [&](const std::string& text) {
                 request.job.run.store.group.age = parse_delay(text);
               }});
}

Certify parse_certify(const std::string& text) {
  if (text == "auto") return Certify::kAuto;
  return text == "on" ? Certify::kOn : Certify::kOff;
}

void add_output_options(OptionSet& options, MeshRequest& request) {
  options.add({.name = "ascii",
               .help = "a .msh as text instead of binary",
               .kind = ValueKind::kSwitch,
               .fallback = "false",
               .assign = [&](const std::string& text) { request.ascii = parse_switch(text); }});
  options.add({.name = "report",
               .value = "FILE.json",
               .help = "writes a report of the run, read back from the finished mesh",
               .assign = [&](const std::string& text) { request.report = text; }});
  options.add({.name = "html",
               .value = "REPORT.html",
               .help = "writes one page to look at: figures, charts, pictures, surfaces to turn",
               .assign = [&](const std::string& text) { request.html = text; }});
  options.add(
      {.name = "certify",
       .help = "on: the mesh is checked like verify does (P1 to P4) before it gets its "
               "name, or the run ends with exit code 5; auto: where one process makes the "
               "mesh and a quarter of --memory is enough",
       .fallback = "auto",
       .choices = {"auto", "on", "off"},
       .assign = [&](const std::string& text) { request.job.certify = parse_certify(text); }});
  options.add({.name = "trace",
               .value = "FILE.csv",
               .help = "writes when each window was worked on, and by which thread",
               .assign = [&](const std::string& text) { request.trace = text; }});
  options.add(
      {.name = "progress",
       .help = "auto (a bar on a terminal), none, jsonl (lines on stderr, with the seconds left)",
       .fallback = "auto",
       .choices = {"auto", "none", "jsonl"},
       .assign = [&](const std::string& text) { request.progress = parse_progress(text); }});
  options.add({.name = "log-level",
               .help = "debug, info, warn, error, off",
               .fallback = "warn",
               .choices = {"debug", "info", "warn", "error", "off"},
               .assign = [&](const std::string& text) { request.log_level = text; }});
}

/// The page is drawn when the mesh is written, in what it leaves of the budget.
void require_memory_for_page(const MeshRequest& request) {
  constexpr std::uint64_t kMin = 192 << 20;
  if (request.html.empty() || request.job.run.store.memory >= kMin) return;
  throw Error(ErrorKind::kUsage, "--html: needs --memory 192MiB or more");
}

void settle_sizes(MeshRequest& request) {
  engine::MeshSettings& settings = request.job.settings;
  add_sizes_of_file(request.size_file, settings.sizes);
  engine::check(settings);
  const bool sized = !settings.sizes.labels.empty() || settings.sizes.inner_vertices;
  if (!sized || settings.optimizer != engine::Optimizer::kTetgen) return;
  throw Error(ErrorKind::kUsage,
              "--optimizer tetgen keeps no sizes or inner vertices: leave out --size and "
              "--inner-vertices, or set --optimizer local");
}

/// What follows from other values.
void settle_job(MeshRequest& request) {
  engine::MeshJob& job = request.job;
  engine::StoreOptions& store = job.run.store;
  if (store.workdir.empty()) store.workdir = request.output.string() + ".work";
  store.memory = request.memory ? *request.memory : engine::default_memory_budget();
  request.volume.cache_bytes = cache_bytes(store.memory);
  job.steps = request.volume.steps;
  job.folder = request.output.parent_path();
  job.is_measured = !request.report.empty() || !request.html.empty();
  job.run.owns_process = true;
}

}  // namespace

void add_mesh_options(OptionSet& options, MeshRequest& request) {
  add_input_option(options, request.volume.path);
  add_output_option(options, request);
  add_volume_options(options, request.volume);
  add_setting_options(options, request.job.settings);
  add_size_file_option(options, request.size_file);
  add_run_options(options, request);
  add_choice_options(options, request.job.choice);
  add_output_options(options, request);
}

void check_mesh_request(MeshRequest& request) {
  require_path(request.output, "-o OUTPUT");
  settle_job(request);
  (void)open_options(request.volume);
  engine::check_choice(request.job.choice);
  require_paths_apart(request);
  require_memory_for_page(request);
  settle_sizes(request);
  if (request.job.settings.optimizer == engine::Optimizer::kTetgen)
    (void)engine::codt::find_worker();
}

}  // namespace mw::cli
