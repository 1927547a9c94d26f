// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mkostemp, unlink, pread and pwrite.
#include "io/file/nameless_file.h"

#include <fcntl.h>

#include <cerrno>
#include <cstdlib>

#include "io/file/errors.h"

namespace mw::io {

NamelessFile::NamelessFile(const std::filesystem::path& folder)
    : folder_(folder.empty() ? "." : folder.string()) {
  std::string path = folder_ + "/" + kScratchPrefix + "XXXXXX";
  file_ = FileDescriptor(::mkostemp(path.data(), O_CLOEXEC));
  if (!file_.valid()) fail_output(folder_, "create a temporary file there", errno);
  ::unlink(path.c_str());
}

void NamelessFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t wrote =
        ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) fail_output(folder_, "write a temporary file there", errno);
    offset += static_cast<std::uint64_t>(wrote);
    bytes = bytes.subspan(static_cast<std::size_t>(wrote));
  }
}

void NamelessFile::read_at(std::uint64_t offset, std::span<std::byte> out) const {
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
