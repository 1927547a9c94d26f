// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the program asks of a run beside its options: names of files that do not collide.
#include "engine/cli/mesh/mesh_paths.h"

#include <algorithm>
#include <vector>

#include "engine/cli/options/file_names.h"
#include "io/file/errors.h"

namespace mw::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& flag, const fs::path& path, const std::string& why) {
  io::fail_usage(flag + " " + path.string() + ": " + why);
}

FileNames files_of(const MeshRequest& request) {
  FileNames files;
  files.read_volume(request.volume);
  for (const std::string& table : request.size_tables) files.read("--size", table);
  files.read("--size", request.job.settings.sizes.rules.image);
  for (const engine::SampleImage& sample : request.job.samples) {
    files.read("--sample", sample.file);
  }
  files.read("--config", request.config);
  files.write_mesh(request.output, request.extras.materials.has_value());
  files.write("--report", request.report);
  files.write("--trace", request.trace);
  files.write("--html", request.html);
  files.write("--delta", request.delta);
  files.write("--pairs", request.extras.pairs);
  return files;
}

/// Returns whether the path is the folder or lies below it.
bool is_at_or_in(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

/// Returns whether the input is a folder that the mesh is written into: the work may be there, too.
bool is_input_around_all(const fs::path& file, const MeshRequest& request) {
  return file == whole_path(request.volume.path) && is_at_or_in(whole_path(request.output), file);
}

void require_folder_apart(const MeshRequest& request, const FileNames& files,
                          const NamedFile& folder) {
  const fs::path workdir = whole_path(folder.path);
  std::vector<NamedFile> all = files.files_read();
  all.insert(all.end(), files.files_written().begin(), files.files_written().end());
  for (const auto& [flag, file, beside] : all) {
    const std::string name = flag == "-o" ? "the output" : flag;
    const fs::path whole = whole_path(file);
    const bool is_in_file = is_at_or_in(workdir, whole), has_file = is_at_or_in(whole, workdir);
    if (!has_file && (!is_in_file || is_input_around_all(whole, request))) continue;
    const std::string why = is_in_file && has_file ? "this is " + name
                            : is_in_file           ? "lies in " + file.string() + ", " + name
                                                   : "has " + file.string() + " in it, " + name;
    refuse(folder.name, folder.path, why + "; give a folder of its own");
  }
}

/// Checks the budget for the page, which is drawn in what the written mesh leaves of it.
void require_memory_for_page(const MeshRequest& request) {
  constexpr std::uint64_t kMin = 192 << 20;
  if (request.html.empty() || request.job.run.store.memory >= kMin) return;
  io::fail_usage("--html: needs --memory 192MiB or more");
}

/// Fills in what the program does beyond what it is asked.
void settle_program(MeshRequest& request) {
  engine::MeshJob& job = request.job;
  engine::StoreOptions& store = job.run.store;
  if (store.workdir.empty()) store.workdir = request.output.string() + ".work";
  job.folder = request.output.parent_path();
  job.is_measured = !request.report.empty() || !request.html.empty();
  job.finds_parts = job.finds_volumes = job.finds_quality = true;
  job.run.owns_process = true;
  store.stays = job.is_measured || !request.trace.empty();
}

/// Checks that the files that are to be replaced are ours (FileNames::require_own()).
void require_own_output(const MeshRequest& request) {
  files_of(request).require_own();
}

/// Checks before any work that names of files are apart (FileNames::require_apart()), and that the
/// work folder neither is one of these files, nor lies in one, nor has one in it.
void require_paths_apart(const MeshRequest& request) {
  const FileNames files = files_of(request);
  files.require_apart();
  const fs::path& kept = request.job.run.keep.folder;
  if (kept.empty()) {
    require_folder_apart(request, files, {"--workdir", request.job.run.store.workdir});
  } else {
    require_folder_apart(request, files, {request.from.empty() ? "--keep" : "--from", kept});
  }
}

}  // namespace

void settle(MeshRequest& request) {
  settle_mesh_request(request);
  settle_program(request);
  require_paths_apart(request);
  if (!request.force) require_own_output(request);
  require_memory_for_page(request);
  check_mesh_request(request);
}

}  // namespace mw::cli
