// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The files of a folder by the paths of requests.
#include "engine/cli/serve/served_folder.h"

#include <algorithm>

#include "kernels/core/error.h"

namespace mw::cli {

ServedFolder::ServedFolder(const std::filesystem::path& folder)
    : root_(std::filesystem::canonical(folder)) {}

std::shared_ptr<const io::FileSource> ServedFolder::open(const std::string& path) const {
  // What is behind a NUL would be dropped by the system, which then opens another file.
  if (path.find('\0') != path.npos) return nullptr;
  std::error_code failed;
  const std::filesystem::path file =
      std::filesystem::canonical(root_.string() + "/" + path, failed);
  if (failed || !has(file)) return nullptr;
  try {
    return std::make_shared<io::FileSource>(file);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInput) return nullptr;  // a folder, or not to be read
    throw;
  }
}

bool ServedFolder::has(const std::filesystem::path& file) const {
  return std::mismatch(root_.begin(), root_.end(), file.begin(), file.end()).first == root_.end();
}

}  // namespace mw::cli
