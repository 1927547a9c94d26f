// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which names of a run collide.
#include "engine/cli/mesh/mesh_request.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <utility>

#include "io/mesh/open_mesh.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

namespace fs = std::filesystem;

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored) || a.lexically_normal() == b.lexically_normal();
}

[[noreturn]] void refuse(const std::string& flag, const fs::path& path, const std::string& why) {
  throw Error(ErrorKind::kUsage, flag + " " + path.string() + ": " + why);
}

std::vector<fs::path> outputs_of(const MeshRequest& request) {
  std::vector<fs::path> out = io::mesh_files(request.output);
  if (request.extras.materials) out.push_back(io::material_table_path(request.output));
  return out;
}

void require_output_apart(const MeshRequest& request) {
  for (const fs::path& output : outputs_of(request)) {
    if (is_same_file(request.volume.path, output)) refuse("-o", output, "this is the input");
    if (is_same_file(request.volume.names, output)) refuse("-o", output, "this is --names");
    for (const std::string& table : request.size_tables) {
      if (is_same_file(table, output)) refuse("-o", output, "this is --size");
    }
    for (const engine::SampleImage& sample : request.job.samples) {
      if (is_same_file(sample.file, output)) refuse("-o", output, "this is --sample");
    }
  }
}

void require_names_used_once(const MeshRequest& request) {
  std::vector<fs::path> taken{request.volume.path, request.volume.names, request.output};
  taken.insert(taken.end(), request.size_tables.begin(), request.size_tables.end());
  for (const engine::SampleImage& sample : request.job.samples) taken.emplace_back(sample.file);
  const std::pair<const char*, fs::path> written[] = {{"--report", request.report},
                                                      {"--trace", request.trace},
                                                      {"--html", request.html},
                                                      {"--delta", request.delta},
                                                      {"--pairs", request.extras.pairs}};
  for (const auto& output : written) {
    const fs::path& path = output.second;
    if (path.empty()) continue;
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
      refuse(output.first, path, "this is a folder; give the name of a file");
    }
    const auto is_it = [&](const fs::path& other) { return is_same_file(path, other); };
    if (std::any_of(taken.begin(), taken.end(), is_it)) {
      refuse(output.first, path, "name used twice");
    }
    taken.push_back(path);
  }
}

/// Returns the path with its links followed as far as it exists, without '/' at its end.
fs::path whole_path(const fs::path& path) {
  std::error_code ignored;
  fs::path whole = fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  if (whole.empty()) whole = fs::absolute(path, ignored).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

/// Returns whether the path is the folder or lies below it.
bool is_at_or_in(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

using Named = std::pair<std::string, fs::path>;

std::vector<Named> files_of(const MeshRequest& request) {
  std::vector<Named> out{{"the input", request.volume.path}, {"--names", request.volume.names},
                         {"--report", request.report},       {"--html", request.html},
                         {"--trace", request.trace},         {"--delta", request.delta},
                         {"--pairs", request.extras.pairs}};
  for (const std::string& table : request.size_tables) out.emplace_back("--size", table);
  for (const engine::SampleImage& sample : request.job.samples) {
    out.emplace_back("--sample", sample.file);
  }
  for (const fs::path& file : outputs_of(request)) out.emplace_back("the output", file);
  std::erase_if(out, [](const Named& file) { return file.second.empty(); });
  return out;
}

/// Returns whether the input is a folder that the mesh is written into: the work may be there, too.
bool is_input_around_all(const fs::path& file, const MeshRequest& request) {
  return file == whole_path(request.volume.path) && is_at_or_in(whole_path(request.output), file);
}

void require_folder_apart(const MeshRequest& request, const std::string& flag,
                          const fs::path& folder) {
  const fs::path workdir = whole_path(folder);
  for (const auto& [name, file] : files_of(request)) {
    const fs::path whole = whole_path(file);
    const bool is_in_file = is_at_or_in(workdir, whole), has_file = is_at_or_in(whole, workdir);
    if (!has_file && (!is_in_file || is_input_around_all(whole, request))) continue;
    const std::string why = is_in_file && has_file ? "this is " + name
                            : is_in_file           ? "lies in " + file.string() + ", " + name
                                                   : "has " + file.string() + " in it, " + name;
    refuse(flag, folder, why + "; give a folder of its own");
  }
}

/// A mesh of ours has one of these near its beginning or its end: the record of its run, or words
/// of the formats that have no place for it.
constexpr std::array<std::string_view, 4> kMarks{"mwmesh", "$MeshFormat\n", "\nTetrahedra of ",
                                                 "placeholders: one for each label"};

std::string ends_of(const fs::path& path) {
  constexpr std::streamoff kBytes = 1 << 16;
  std::ifstream file(path, std::ios::binary);
  std::string out(2 * kBytes, '\0');
  file.read(out.data(), kBytes);
  if (!file) return out;
  file.seekg(-kBytes, std::ios::end);
  file.read(out.data() + kBytes, kBytes);
  return out;
}

}  // namespace

void require_own_output(const fs::path& output) {
  std::error_code ignored;
  if (!fs::is_regular_file(output, ignored) || fs::file_size(output, ignored) == 0) return;
  const std::string ends = ends_of(output);
  const bool is_ours = std::any_of(kMarks.begin(), kMarks.end(), [&](std::string_view mark) {
    return ends.find(mark) != ends.npos;
  });
  if (!is_ours) refuse("-o", output, "is there, and no mesh of mwmesh; --force replaces it");
}

void require_paths_apart(const MeshRequest& request) {
  require_output_apart(request);
  require_names_used_once(request);
  const fs::path& kept = request.job.run.keep.folder;
  if (kept.empty()) {
    require_folder_apart(request, "--workdir", request.job.run.store.workdir);
  } else {
    require_folder_apart(request, request.from.empty() ? "--keep" : "--from", kept);
  }
}

}  // namespace mw::cli
