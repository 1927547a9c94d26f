// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which names of a command's files collide.
#include "engine/cli/options/file_names.h"

#include <algorithm>
#include <span>
#include <utility>

#include "engine/cli/options/own_files.h"
#include "io/file/errors.h"
#include "io/mesh/grouped/material_sets.h"
#include "io/mesh/open_mesh.h"
#include "io/volume/masks/open_masks.h"

namespace mw::cli {
namespace {

namespace fs = std::filesystem;

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored) || whole_path(a) == whole_path(b);
}

[[noreturn]] void refuse_file(const NamedFile& file, const std::string& why) {
  io::fail_usage(file.name + " " + file.path.string() + ": " + why);
}

/// Throws if one of the others is that file.
void require_other(const NamedFile& file, std::span<const NamedFile> others) {
  const auto same = std::find_if(others.begin(), others.end(), [&](const NamedFile& other) {
    return is_same_file(file.path, other.path);
  });
  if (same == others.end()) return;
  refuse_file(file, "name used twice, this is " + same->name + "; give another name");
}

}  // namespace

void FileNames::read(std::string name, fs::path path) {
  if (!path.empty()) read_.push_back({std::move(name), std::move(path)});
}

void FileNames::read_volume(const VolumeRequest& volume) {
  read("the input", volume.path);
  for (const fs::path& mask : io::listed_masks(volume.path)) read("the input", mask);
  read("--names", volume.names);
}

void FileNames::read_mesh(const fs::path& mesh) {
  for (const fs::path& file : io::mesh_sources(mesh)) read("the mesh to read", file);
}

void FileNames::write(std::string flag, fs::path path) {
  if (!path.empty()) written_.push_back({std::move(flag), std::move(path)});
}

void FileNames::write_mesh(const fs::path& mesh, bool has_materials) {
  for (const fs::path& file : files_of_mesh(mesh, has_materials)) {
    written_.push_back({"-o", file, file == mesh ? fs::path() : mesh});
  }
}

void FileNames::require_apart() const {
  for (std::size_t i = 0; i < written_.size(); ++i) {
    const NamedFile& file = written_[i];
    std::error_code ignored;
    if (fs::is_directory(file.path, ignored)) {
      refuse_file(file, "this is a folder; give the name of a file");
    }
    require_other(file, read_);
    require_other(file, std::span(written_).first(i));
  }
}

void FileNames::require_own() const {
  for (const NamedFile& file : written_) require_own_file(file);
}

void require_own_file(const NamedFile& file) {
  // A mesh that is there is ours, as it comes first, and what is beside it was written with it.
  if (is_filled(file.mesh) || !is_foreign(file.path)) return;
  const std::string why =
      file.mesh.empty() ? "" : ", but would be written with " + file.mesh.string();
  refuse_file(file, "is there, and not of mwmesh" + why + "; --force replaces it");
}

std::vector<fs::path> files_of_mesh(const fs::path& mesh, bool has_materials) {
  std::vector<fs::path> out = io::mesh_files(mesh);
  if (has_materials) out.push_back(io::material_table_path(mesh));
  return out;
}

fs::path whole_path(const fs::path& path) {
  std::error_code ignored;
  fs::path whole = fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  if (whole.empty()) whole = fs::absolute(path, ignored).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

}  // namespace mw::cli
