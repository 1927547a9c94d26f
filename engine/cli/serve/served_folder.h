// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The files of a folder by the paths of requests.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "io/file/source/file_source.h"

namespace mw::cli {

/// Thread safety: all members may be called from many threads.
class ServedFolder {
 public:
  /// ERRORS: std::filesystem::filesystem_error if there is no such folder.
  explicit ServedFolder(const std::filesystem::path& folder);

  /// Returns the open file; null where the folder has no file of this path, which begins with '/'.
  /// Links are followed only to where they stay in the folder.
  /// ERRORS: mw::Error(kResource) when too many files are open.
  [[nodiscard]] std::shared_ptr<const io::FileSource> open(const std::string& path) const;

 private:
  [[nodiscard]] bool has(const std::filesystem::path& file) const;

  std::filesystem::path root_;  ///< without links
};

}  // namespace mw::cli
