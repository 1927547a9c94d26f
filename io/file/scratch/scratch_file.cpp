// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Temporary files without a name.
#include "io/file/scratch/scratch_file.h"

#include <fcntl.h>

#include <cerrno>
#include <cstdlib>

#include "io/file/errors.h"
#include "io/file/file_descriptor.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

/// Opens a file that never has a name, so that no kill leaves it; not every file system can do so.
int open_nameless(const std::string& folder) {
  return ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
}

/// Returns the folder as messages call it: nobody gave the one that the environment names.
std::string told(const std::string& folder) {
  const char* chosen = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe)
  return (chosen != nullptr && chosen == folder ? "TMPDIR=" : "") + folder;
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
  if (!file_.valid()) fail_output(told(folder_), "create a temporary file there", errno);
}

void UnlinkedFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) const {
  const Transfer done = write_all(file_.get(), offset, bytes);
  if (done.error != 0) fail_output(told(folder_), "write a temporary file there", done.error);
}

void UnlinkedFile::read_at(std::uint64_t offset, std::span<std::byte> out) const {
  const Transfer done = read_all(file_.get(), offset, out);
  if (done.bytes == out.size()) return;
  fail_output(told(folder_), "read a temporary file there", done.error != 0 ? done.error : EIO);
}

void UnlinkedFile::give_up(std::uint64_t offset, std::uint64_t bytes) const {
  // Where the file system cannot do it, the bytes go with the file.
  if (bytes == 0) return;
  ::fallocate(file_.get(), FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(offset),
              static_cast<off_t>(bytes));
}

std::filesystem::path scratch_folder() {
  const char* chosen = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe)
  return chosen != nullptr && *chosen != '\0' ? chosen : "/tmp";
}

namespace {

constexpr std::size_t kBufferBytes = 1 << 18;

}  // namespace

void ScratchFile::append(std::span<const std::byte> bytes) {
  if (buffer_.size() + bytes.size() > kBufferBytes) flush();
  if (bytes.size() >= kBufferBytes) {
    write(bytes);
  } else {
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  }
}

void ScratchFile::flush() {
  if (buffer_.empty()) return;
  write(buffer_);
  buffer_.clear();
}

void ScratchFile::write(std::span<const std::byte> bytes) {
  file_.write_at(flushed_, bytes);
  flushed_ += bytes.size();
}

void ScratchFile::read_at(std::uint64_t offset, std::span<std::byte> out) {
  MW_ASSERT(offset <= size() && out.size() <= size() - offset);
  flush();
  file_.read_at(offset, out);
}

FileDescriptor ScratchFile::release() {
  flush();
  return file_.release();
}

}  // namespace mw::io
