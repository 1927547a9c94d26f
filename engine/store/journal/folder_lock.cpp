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
#include <span>
#include <string>

#include "io/file/errors.h"
#include "io/file/folder.h"
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

/// Returns the content of a lock file; one byte more than the mark has where it is longer, nothing
/// where it cannot be read.
std::string content_of(const fs::path& path) {
  std::string out(kMark.size() + 1, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(out.data(), static_cast<std::streamsize>(out.size()));
  out.resize(static_cast<std::size_t>(in.gcount()));
  return out;
}

/// True for what a kill or a power cut leaves of the mark while it is written: bytes that have not
/// reached the disk are missing or 0.
bool is_part_of_mark(std::string_view content) {
  if (content.size() > kMark.size()) return false;
  return std::equal(content.begin(), content.end(), kMark.begin(),
                    [](char byte, char marked) { return byte == 0 || byte == marked; });
}

/// Writes the mark where it is not whole.
void mark(const io::FileDescriptor& file, const fs::path& path) {
  std::string content(kMark.size(), '\0');
  const io::Transfer found =
      io::read_all(file.get(), 0, std::as_writable_bytes(std::span(content)));
  if (found.bytes == kMark.size() && content == kMark) return;
  const io::Transfer done = io::write_all(file.get(), 0, std::as_bytes(std::span(kMark)));
  if (done.error != 0) io::fail_output(path.string(), "write", done.error);
  if (::fsync(file.get()) != 0) io::fail_output(path.string(), "write", errno);
  io::sync_folder(path.parent_path());
}

}  // namespace

bool is_of_runs(const fs::path& folder) {
  const std::string content = content_of(folder / kLockFile);
  if (content == kMark) return true;
  if (!is_part_of_mark(content)) return false;
  std::error_code failed;
  const std::vector<std::string> names = io::entries_in(folder, failed);
  return !failed && std::ranges::all_of(names, [](const auto& name) { return name == kLockFile; });
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
