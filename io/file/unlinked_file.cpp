// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A file without a name, pread and pwrite.
#include "io/file/unlinked_file.h"

#include <fcntl.h>

#include <cerrno>
#include <cstdlib>

#include "io/file/errors.h"

namespace mw::io {
namespace {

/// Where the file system can do that: without ever having a name, so that no kill leaves one.
int open_nameless(const std::string& folder) {
  return ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
}

int open_and_unlink(const std::string& folder) {
  std::string path = folder + "/" + kScratchPrefix + "XXXXXX";
  const int file = ::mkostemp(path.data(), O_CLOEXEC);
  if (file >= 0) ::unlink(path.c_str());
  return file;
}

}  // namespace

UnlinkedFile::UnlinkedFile(const std::filesystem::path& folder)
    : folder_(folder.empty() ? "." : folder.string()) {
  file_ = FileDescriptor(open_nameless(folder_));
  if (!file_.valid()) file_ = FileDescriptor(open_and_unlink(folder_));
  if (!file_.valid()) fail_output(folder_, "create a temporary file there", errno);
}

void UnlinkedFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t wrote =
        ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) fail_output(folder_, "write a temporary file there", errno);
    offset += static_cast<std::uint64_t>(wrote);
    bytes = bytes.subspan(static_cast<std::size_t>(wrote));
  }
}

void UnlinkedFile::read_at(std::uint64_t offset, std::span<std::byte> out) const {
  while (!out.empty()) {
    const ssize_t got = ::pread(file_.get(), out.data(), out.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail_output(folder_, "read a temporary file there", got < 0 ? errno : EIO);
    offset += static_cast<std::uint64_t>(got);
    out = out.subspan(static_cast<std::size_t>(got));
  }
}

std::filesystem::path scratch_folder() {
  const char* chosen = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe)
  return chosen != nullptr && *chosen != '\0' ? chosen : "/tmp";
}

}  // namespace mw::io
