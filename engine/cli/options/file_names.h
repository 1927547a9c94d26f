// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which names of a command's files collide.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/cli/requests.h"

namespace mw::cli {

/// A file, and what the user knows it by: "--report", "the input".
struct NamedFile {
  std::string name;
  std::filesystem::path path;
  std::filesystem::path mesh{};  ///< beside which it is written; empty unless there is one
};

/// The files of a command; those with an empty path are not there.
class FileNames {
 public:
  void read(std::string name, std::filesystem::path path);
  /// Adds the files that a volume is read from, as far as its path names them, and --names.
  void read_volume(const VolumeRequest& volume);
  /// Adds the files that a mesh is read from.
  void read_mesh(const std::filesystem::path& mesh);
  void write(std::string flag, std::filesystem::path path);
  /// Adds the files that are written for a mesh: its own, those beside it, and the table of its
  /// materials if it has some.  All of them are known as "-o".
  void write_mesh(const std::filesystem::path& mesh, bool has_materials);

  /// Checks before any work that no file is both read and written, and that none is written twice.
  /// ERRORS: mw::Error(kUsage) naming the flag, the path, and what else has that name.
  void require_apart() const;
  /// Checks that the files that are to be replaced are empty or were written by this program, as
  /// those beside a mesh of its own were.  ERRORS: mw::Error(kUsage) naming --force.
  void require_own() const;

  [[nodiscard]] const std::vector<NamedFile>& files_read() const { return read_; }
  [[nodiscard]] const std::vector<NamedFile>& files_written() const { return written_; }

 private:
  std::vector<NamedFile> read_;
  std::vector<NamedFile> written_;
};

/// Checks one file, which is written under this flag, as FileNames::require_own() does.
void require_own_file(const NamedFile& file);

/// Returns the files that are written for a mesh: its own, those beside it, and the table of its
/// materials if it has some.
[[nodiscard]] std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& mesh,
                                                               bool has_materials);

/// Returns the path with its links followed as far as it exists, without '/' at its end.
[[nodiscard]] std::filesystem::path whole_path(const std::filesystem::path& path);

}  // namespace mw::cli
