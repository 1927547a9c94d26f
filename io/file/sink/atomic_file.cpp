// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Output files that appear under their names only when they are whole.
#include "io/file/sink/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string>

#include "io/file/errors.h"
#include "io/file/file_descriptor.h"
#include "io/file/sink/partial_file.h"
#include "kernels/core/assert.h"
#include "kernels/core/error.h"

namespace mw::io {
namespace {

constexpr std::size_t kBufferBytes = 1 << 20;

/// Follows a link, so that the file it names is replaced or made, and not the link; refuses
/// anything that exists and is no plain file (a folder, a device).
std::filesystem::path resolve(const std::filesystem::path& target) {
  std::error_code ignored;
  const auto status = std::filesystem::status(target, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    fail_usage(target.string() +
               ": cannot create: exists and is not a regular file; give the "
               "path of a file");
  }
  constexpr int kMostLinks = 40;  // as many as Linux follows
  std::filesystem::path file = target;
  for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(file, ignored); ++i) {
    file = file.parent_path() / std::filesystem::read_symlink(file, ignored);
  }
  return file;
}

using Files = std::span<const std::reference_wrapper<AtomicFile>>;

/// Removes the old files down to the second; the new first one replaces the old in one step.
void remove_old(Files files) {
  for (std::size_t i = files.size(); i-- > 1;) files[i].get().remove_named();
}

/// Removes new files after an error, which the caller reports; what cannot be removed stays.
void take_back(Files files) {
  try {
    for (std::size_t i = files.size(); i-- > 0;) files[i].get().remove_named();
  } catch (const Error&) {
    return;
  }
}

/// Returns the target without a '/' at its end.  Only an empty folder may be there.
std::filesystem::path free_target(const std::filesystem::path& target) {
  std::filesystem::path name = target.has_filename() ? target : target.parent_path();
  std::error_code failed;
  const bool exists = std::filesystem::exists(name, failed);
  const bool is_free = !exists || (std::filesystem::is_directory(name, failed) &&
                                   std::filesystem::is_empty(name, failed));
  if (is_free && !failed && name.has_filename()) return name;
  fail_usage(target.string() +
             ": is written as a new folder, and there is something already; "
             "remove it or give another name");
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target) : target_(resolve(target)) {
  if (!target_.has_filename()) {
    fail_usage(target.string() + ": cannot create: no file name in the path");
  }
  buffer_.reserve(kBufferBytes);  // first: a failure after make_partial() leaves its file
  PartialOutput partial = make_partial(target_, PartialKind::kFile);
  partial_ = std::move(partial.path);
  file_ = std::move(partial.file);
}

AtomicFile::~AtomicFile() {
  if (!committed_) ::unlink(partial_.c_str());
}

void AtomicFile::append(std::span<const std::byte> bytes) {
  if (buffer_.size() + bytes.size() > kBufferBytes) flush();
  if (bytes.size() >= kBufferBytes) {
    write(flushed_, bytes);
    flushed_ += bytes.size();
  } else {
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  }
}

void AtomicFile::append(std::string_view text) {
  append(std::as_bytes(std::span(text)));
}

void AtomicFile::append_line(std::string_view line, std::string_view more) {
  append(line);
  append(more);
  append("\n");
}

void AtomicFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  flush();
  write(offset, bytes);
}

void AtomicFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  MW_ASSERT(!committed_);
  const Transfer done = write_all(file_.get(), offset, bytes);
  if (done.error != 0) fail_output(target_.string(), "write", done.error);
}

void AtomicFile::read_at(std::uint64_t offset, std::span<std::byte> out) const {
  const Transfer done = read_all(file_.get(), offset, out);
  if (done.error != 0) fail_output(target_.string(), "read back", done.error);
  const std::span<std::byte> behind = out.subspan(done.bytes);
  std::fill(behind.begin(), behind.end(), std::byte{0});
}

void AtomicFile::resize(std::uint64_t bytes) {
  MW_ASSERT(!committed_);
  if (::ftruncate(file_.get(), static_cast<off_t>(bytes)) != 0) {
    fail_output(target_.string(), "resize", errno);
  }
}

void AtomicFile::flush() {
  write(flushed_, buffer_);
  flushed_ += buffer_.size();
  buffer_.clear();
}

void AtomicFile::commit() {
  sync();
  give_name();
}

void AtomicFile::sync() {
  flush();
  if (::fsync(file_.get()) != 0) fail_output(target_.string(), "sync", errno);
}

void AtomicFile::remove_named() {
  if (::unlink(target_.c_str()) == 0) {
    sync_folder(folder_of(target_));
  } else if (errno != ENOENT) {
    fail_output(target_.string(), "replace", errno);
  }
}

void AtomicFile::give_name() {
  if (std::rename(partial_.c_str(), target_.c_str()) != 0) {
    fail_output(target_.string(), "rename to", errno);
  }
  committed_ = true;
  ::flock(file_.get(), LOCK_UN);  // the HDF5 library, for one, opens no file that is locked
  sync_folder(folder_of(target_));
}

void commit_together(std::initializer_list<std::reference_wrapper<AtomicFile>> list) {
  const Files files(list.begin(), list.size());
  for (AtomicFile& file : files) file.sync();
  remove_old(files);
  std::size_t named = 0;
  try {
    for (; named < files.size(); ++named) files[named].get().give_name();
  } catch (const Error&) {
    take_back(files.first(named));
    throw;
  }
}

AtomicFolder::AtomicFolder(const std::filesystem::path& target) : target_(free_target(target)) {
  PartialOutput partial = make_partial(target_, PartialKind::kFolder);
  partial_ = std::move(partial.path);
  lock_ = std::move(partial.file);
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove_all(partial_, ignored);
}

void AtomicFolder::commit() {
  if (std::rename(partial_.c_str(), target_.c_str()) != 0) {
    fail_output(target_.string(), "rename to", errno);
  }
  sync_folder(folder_of(target_));
  committed_ = true;
  lock_ = FileDescriptor();
}

void AtomicFolder::withdraw() {
  std::error_code ignored;
  std::filesystem::remove_all(target_, ignored);
}

}  // namespace mw::io
