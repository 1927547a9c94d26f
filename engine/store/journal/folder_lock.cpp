// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A locked file with one line in it.
#include "engine/store/journal/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <string>

#include "io/file/errors.h"
#include "io/file/sink/partial_file.h"

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = "mwmesh made this folder and removes its files.\n";

/// True if the locked file still has that name: a run that ends removes it.
bool is_at(const io::FileDescriptor& file, const fs::path& path) {
  struct stat held {};
  struct stat named {};
  return ::fstat(file.get(), &held) == 0 && ::stat(path.c_str(), &named) == 0 &&
         held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

/// Writes the mark where it is missing: a run may have been killed before it wrote all of it.
void mark(const io::FileDescriptor& file, const fs::path& path) {
  struct stat held {};
  if (::fstat(file.get(), &held) != 0) io::fail_output(path.string(), "look at", errno);
  if (held.st_size == static_cast<off_t>(kMark.size())) return;
  if (::pwrite(file.get(), kMark.data(), kMark.size(), 0) != static_cast<ssize_t>(kMark.size()) ||
      ::fsync(file.get()) != 0) {
    io::fail_output(path.string(), "write", errno);
  }
  io::sync_folder(path.parent_path());
}

}  // namespace

bool is_of_runs(const fs::path& folder) {
  std::ifstream in(folder / kLockFile);
  std::string line;
  if (std::getline(in, line)) return line + "\n" == kMark;
  std::error_code failed;
  const fs::directory_iterator entries(folder, failed);
  if (failed) return false;
  return std::all_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
    return entry.path().filename() == kLockFile;
  });
}

std::optional<io::FileDescriptor> lock_folder(const fs::path& folder) {
  const fs::path path = folder / kLockFile;
  io::FileDescriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (!file.valid() && errno == ENOENT) return file;
  if (!file.valid()) io::fail_output(path.string(), "create", errno);
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return std::nullopt;
    io::fail_output(path.string(), "lock", errno);
  }
  if (!is_at(file, path)) return io::FileDescriptor();
  mark(file, path);
  return file;
}

}  // namespace mw::engine
