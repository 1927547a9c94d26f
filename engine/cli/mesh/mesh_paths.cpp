// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which names of a run collide.
#include "engine/cli/mesh/mesh_request.h"

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

}  // namespace

void require_own_output(const MeshRequest& request) {
  files_of(request).require_own();
}

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

}  // namespace mw::cli
