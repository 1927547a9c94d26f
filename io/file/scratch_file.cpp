// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mkostemp, unlink, pread and pwrite.
#include "io/file/scratch_file.h"

#include <fcntl.h>

#include <cerrno>
#include <cstdlib>

#include "io/file/errors.h"

namespace mw::io {

ScratchFile::ScratchFile(std::string purpose) : purpose_(std::move(purpose)) {
  const char* chosen = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe)
  folder_ = chosen != nullptr && *chosen != '\0' ? chosen : "/tmp";
  std::string path = folder_ + "/mwmesh-XXXXXX";
  file_ = FileDescriptor(::mkostemp(path.data(), O_CLOEXEC));
  if (!file_.valid()) fail_output(folder_, "create a temporary file (TMPDIR)", errno);
  ::unlink(path.c_str());
}

void ScratchFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t wrote =
        ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) fail_output(folder_, "write " + purpose_ + " (TMPDIR)", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(wrote));
    offset += static_cast<std::uint64_t>(wrote);
  }
}

void ScratchFile::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got =
        ::pread(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0)
      fail_output(folder_, "read back " + purpose_ + " (TMPDIR)", got < 0 ? errno : EIO);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
    offset += static_cast<std::uint64_t>(got);
  }
}

}  // namespace mw::io
