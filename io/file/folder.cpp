// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Folders are listed by the system's own calls.
#include "io/file/folder.h"

#include <dirent.h>

#include <algorithm>
#include <cerrno>
#include <memory>

#include "io/file/errors.h"

namespace mw::io {

namespace {

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

std::error_code last_error() {
  return {errno, std::generic_category()};
}

}  // namespace

std::vector<std::string> entries_in(const std::filesystem::path& folder, std::error_code& error) {
  error.clear();
  std::vector<std::string> names;
  const std::unique_ptr<DIR, CloseFolder> handle(::opendir(folder.c_str()));
  if (!handle) {
    error = last_error();
    return names;
  }
  while (true) {
    errno = 0;
    const dirent* const entry = ::readdir(handle.get());
    if (entry == nullptr) break;
    std::string name = static_cast<const char*>(entry->d_name);
    if (name != "." && name != "..") names.push_back(std::move(name));
  }
  if (errno != 0) error = last_error();
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> entries_in(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::string> names = entries_in(folder, error);
  if (!error) return names;
  fail_input(folder.string(), {}, "cannot list: " + error.message(), "check the path");
}

}  // namespace mw::io
