// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh surface straight from a volume.
#include "engine/cli/surface/surface_volume.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <iostream>

#include "engine/cli/exit_code.h"
#include "engine/cli/log.h"
#include "engine/cli/mesh/progress.h"
#include "engine/report/attention.h"
#include "engine/system/crew.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/open_mesh.h"
#include "io/remote/wait_stop.h"

namespace mw::cli {
namespace {

constexpr std::array<std::string_view, 3> kListed{"preset", "size", "names"};

OptionSet options_of(MeshRequest& request) {
  OptionSet options;
  add_volume_options(options, request.volume);
  add_step_options(options, request.volume);
  add_setting_options(options, request.job.settings);
  add_resource_options(options, request.job.run.threads, request.memory, "bound for the process");
  return options;
}

/// Returns whether the labels can be told from voxels as they are read.
bool are_of_voxels(const MeshRequest& request, const std::vector<RawLabel>& labels) {
  const bool has_background = std::find(labels.begin(), labels.end(), RawLabel{0}) != labels.end();
  return !has_background && request.volume.open.object.empty() &&
         request.volume.steps.merge.empty() && request.job.settings.periodic == 0 &&
         request.volume.open.values == io::VoxelValues::kLabels;
}

void choose(MeshRequest& request, const std::vector<RawLabel>& labels) {
  if (labels.empty()) return;
  if (are_of_voxels(request, labels)) {
    request.volume.open.object = labels;
  } else {
    request.job.choice.labels = labels;
  }
}

std::filesystem::path work_folder() {
  return io::scratch_folder() / io::text(io::kScratchPrefix, "surface-", ::getpid(), ".work");
}

/// Opens the volume; errors do not name an option that nobody gave.
std::unique_ptr<io::LabelVolume> open_asked(const MeshRequest& request) {
  try {
    return open(request.volume, log_warning);
  } catch (const Error& error) {
    constexpr std::string_view kOption = "--object: ";
    std::string message = error.what();
    const std::size_t at = message.find(kOption);
    if (at == message.npos) throw;
    throw Error(error.kind(), message.erase(at, kOption.size()));
  }
}

void settle_run(MeshRequest& request) {
  engine::MeshJob& job = request.job;
  job.folder = io::scratch_folder();
  job.stop = stop_if_interrupted;
  job.warn = log_warning;
  job.run.owns_process = true;
  job.run.threads = engine::thread_count(job.run.threads);
  job.run.store.workdir = work_folder();
  job.run.store.is_scratch = true;
}

}  // namespace

bool is_volume(const std::filesystem::path& input) {
  return !io::is_mesh_path(input) && input.extension() != io::kPiecesExtension;
}

void add_volume_route(OptionSet& options, MeshRequest& request) {
  constexpr const char* kGroup = "From a volume";
  const OptionSet route = options_of(request);
  for (const OptionSet::Entry& entry : route.entries()) {
    Option option = entry.option;
    const bool is_listed = std::find(kListed.begin(), kListed.end(), option.name) != kListed.end();
    if (is_listed) option.group = kGroup;
    if (option.listed != Listed::kNowhere) {
      option.listed = is_listed ? Listed::kInHelp : Listed::kInHelpAll;
    }
    options.add(std::move(option));
  }
}

void refuse_flags_of_volumes(const OptionSet& options, const std::filesystem::path& mesh) {
  MeshRequest unused;
  const OptionSet route = options_of(unused);
  for (const OptionSet::Entry& entry : route.entries()) {
    if (!options.is_flag(entry.option.name)) continue;
    io::fail_usage("--", entry.option.name, ": is about volumes, and ", mesh.string(),
                   " is a mesh; leave it out");
  }
}

void mesh_volume(MeshRequest& request, const std::vector<RawLabel>& labels, io::MeshSink& sink) {
  watch_interrupts();
  choose(request, labels);
  settle_mesh_request(request);
  settle_run(request);
  check_mesh_request(request);
  const io::WaitStop waits(&request.job.stop);
  const std::unique_ptr<io::LabelVolume> volume = open_asked(request);
  open_images(request, request.job);
  Progress progress(parse_progress("auto"));
  request.job.run.progress = [&](const engine::RunProgress& at) { progress.show(at); };
  const report::FinishedRun run = engine::mesh(*volume, request.job, std::array{&sink});
  std::cout << "meshed      " << with_commas(run.engine.tets) << " tets";
  if (!request.volume.open.object.empty()) std::cout << ", all other labels taken for one";
  if (run.leaves_out_zero) std::cout << ", without label 0, as the names say that it is nothing";
  const std::string note = report::spacing_text(run);
  std::cout << (note.empty() ? "" : "\nnote        ") << note << std::endl;
}

}  // namespace mw::cli
