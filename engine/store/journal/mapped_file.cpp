// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Mappings that last for one access; space is reserved first.
#include "engine/store/journal/mapped_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <boost/interprocess/mapped_region.hpp>
#include <cerrno>
#include <cstring>

#include "io/file/errors.h"
#include "io/file/file_descriptor.h"
#include "io/file/sink/partial_file.h"
#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

namespace ipc = boost::interprocess;

/// Makes the file if it is not there, and syncs its folder, so that the name survives a power cut.
void make(const std::filesystem::path& path) {
  const io::FileDescriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (!file.valid()) io::fail_output(path.string(), "create", errno);
  io::sync_folder(path.parent_path());
}

ipc::file_mapping open_mapping(const std::string& path) {
  try {
    return {path.c_str(), ipc::read_write};
  } catch (const ipc::interprocess_exception& e) {
    io::fail_output(path, "open", e.get_native_error());
  }
}

ipc::mapped_region map(const ipc::file_mapping& file, const std::string& path, ipc::mode_t mode,
                       std::uint64_t offset, std::uint64_t size) {
  try {
    return {file, mode, static_cast<ipc::offset_t>(offset), static_cast<std::size_t>(size)};
  } catch (const ipc::interprocess_exception& e) {
    io::fail_output(path, "map", e.get_native_error());
  }
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) : path_(path.string()) {
  make(path);
  mapping_ = open_mapping(path_);
  struct stat facts {};
  if (::fstat(handle(), &facts) != 0) io::fail_output(path_, "look at", errno);
  size_ = static_cast<std::uint64_t>(facts.st_size);
}

void MappedFile::resize(std::uint64_t size) {
  if (size < size_ && ::ftruncate(handle(), static_cast<off_t>(size)) != 0) {
    io::fail_output(path_, "shorten", errno);
  }
  if (size > size_) {
    int error = EINTR;
    while (error == EINTR) {
      error = ::posix_fallocate(handle(), static_cast<off_t>(size_.load()),
                                static_cast<off_t>(size - size_));
    }
    if (error != 0) io::fail_output(path_, "reserve space", error);
  }
  size_ = size;
}

void MappedFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  MW_ASSERT(offset + bytes.size() <= size_);
  while (!bytes.empty()) {
    const std::size_t part = std::min<std::size_t>(bytes.size(), kMappedAtOnce);
    const ipc::mapped_region region = map(mapping_, path_, ipc::read_write, offset, part);
    std::memcpy(region.get_address(), bytes.data(), part);
    offset += part;
    bytes = bytes.subspan(part);
  }
}

void MappedFile::read(std::uint64_t offset, std::uint64_t size, const UseBytes& use) const {
  MW_ASSERT(offset + size <= size_);
  if (size == 0) return use({});
  const ipc::mapped_region region = map(mapping_, path_, ipc::read_only, offset, size);
  use({static_cast<const std::byte*>(region.get_address()), static_cast<std::size_t>(size)});
}

void MappedFile::prefetch(std::uint64_t offset, std::uint64_t size) const {
  ::posix_fadvise(handle(), static_cast<off_t>(offset), static_cast<off_t>(size),
                  POSIX_FADV_WILLNEED);
}

void MappedFile::sync() {
  if (::fdatasync(handle()) != 0) io::fail_output(path_, "sync", errno);
}

}  // namespace mw::engine
