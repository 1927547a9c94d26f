// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A temporary file without a name.
#include "io/file/scratch_file.h"

#include <fcntl.h>

#include <cerrno>
#include <cstdlib>

#include "io/file/errors.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

constexpr std::size_t kBufferBytes = 1 << 18;

}  // namespace

ScratchFile::ScratchFile(const std::filesystem::path& folder)
    : folder_(folder.empty() ? "." : folder.string()) {
  std::string path = folder_ + "/.mwmesh-scratch-XXXXXX";
  file_ = FileDescriptor(::mkostemp(path.data(), O_CLOEXEC));
  if (!file_.valid()) fail_output(folder_, "create a temporary file there", errno);
  ::unlink(path.c_str());
}

void ScratchFile::append(std::span<const std::byte> bytes) {
  if (buffer_.size() + bytes.size() > kBufferBytes) flush();
  if (bytes.size() >= kBufferBytes) {
    write(bytes);
  } else {
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  }
}

void ScratchFile::flush() {
  write(buffer_);
  buffer_.clear();
}

void ScratchFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t wrote =
        ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(flushed_));
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) fail_output(folder_, "write a temporary file there", errno);
    flushed_ += static_cast<std::uint64_t>(wrote);
    bytes = bytes.subspan(static_cast<std::size_t>(wrote));
  }
}

void ScratchFile::read_at(std::uint64_t offset, std::span<std::byte> out) {
  MW_ASSERT(offset <= size() && out.size() <= size() - offset);
  flush();
  while (!out.empty()) {
    const ssize_t got = ::pread(file_.get(), out.data(), out.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail_output(folder_, "read a temporary file there", got < 0 ? errno : EIO);
    offset += static_cast<std::uint64_t>(got);
    out = out.subspan(static_cast<std::size_t>(got));
  }
}

FileDescriptor ScratchFile::release() {
  flush();
  return std::move(file_);
}

std::filesystem::path scratch_folder() {
  const char* chosen = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe)
  return chosen != nullptr && *chosen != '\0' ? chosen : "/tmp";
}

}  // namespace mw::io
