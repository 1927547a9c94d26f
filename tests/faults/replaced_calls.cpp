// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// System calls on files as LD_PRELOAD puts them before the C library's: each may fail as planned,
// and is recorded when it has done something.
#include <dlfcn.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <map>
#include <mutex>
#include <optional>

#include "tests/faults/fault_plan.h"

namespace mw::faults {
namespace {

/// The function that would have been called.
template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

/// Sets errno if the call is to fail.
Fault on(const char* call, const std::string& path) {
  const Fault fault = next_fault(call, path);
  if (fault.fails()) errno = fault.error;
  return fault;
}

std::size_t cut(const Fault& fault, std::size_t size) {
  return fault.is_short && size > 1 ? size / 2 : size;
}

std::uint64_t position(off_t offset) {
  return static_cast<std::uint64_t>(offset);
}

std::uint64_t size_of(int file) {
  struct stat facts {};
  return ::fstat(file, &facts) == 0 ? position(facts.st_size) : 0;
}

void record_write(int file, const void* data, ssize_t wrote, off_t offset) {
  if (wrote <= 0) return;
  record({.name = "write",
          .path = path_of(file),
          .offset = position(offset),
          .size = static_cast<std::uint64_t>(wrote),
          .data = data});
}

/// A mapping through which a watched file may be written.
struct Mapping {
  std::string path;
  std::uint64_t offset = 0;
  std::size_t size = 0;
};

std::mutex& mappings_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::map<void*, Mapping>& mappings() {
  static std::map<void*, Mapping> all;
  return all;
}

std::optional<Mapping> forget_mapping(void* at) {
  const std::lock_guard lock(mappings_mutex());
  const auto found = mappings().find(at);
  if (found == mappings().end()) return std::nullopt;
  const Mapping mapping = found->second;
  mappings().erase(found);
  return mapping;
}

using Open = int(const char*, int, ...);

int open_file(const char* name, const char* path, int flags, mode_t mode) {
  const std::string full = absolute(path);
  if (on("open", full).fails()) return -1;
  const bool is_new = (flags & O_CREAT) != 0 && ::access(path, F_OK) != 0;
  const int file = next<Open>(name)(path, flags, mode);
  if (file >= 0 && is_new) record({.name = "create", .path = full});
  if (file >= 0 && (flags & O_TRUNC) != 0) record({.name = "resize", .path = full});
  return file;
}

using Write = ssize_t(int, const void*, std::size_t, off_t);

ssize_t write_at(int file, const void* data, std::size_t size, off_t offset) {
  const Fault fault = on("pwrite", path_of(file));
  if (fault.fails()) return -1;
  const ssize_t wrote = next<Write>("pwrite64")(file, data, cut(fault, size), offset);
  record_write(file, data, wrote, offset);
  return wrote;
}

using Read = ssize_t(int, void*, std::size_t, off_t);

ssize_t read_at(int file, void* data, std::size_t size, off_t offset) {
  const Fault fault = on("pread", path_of(file));
  if (fault.fails()) return -1;
  return next<Read>("pread64")(file, data, cut(fault, size), offset);
}

int sync(const char* name, int file) {
  const std::string path = path_of(file);
  if (on(name, path).fails()) return -1;
  const int result = next<int(int)>(name)(file);
  if (result == 0) record({.name = "sync", .path = path});
  return result;
}

int resize(int file, off_t size) {
  const std::string path = path_of(file);
  if (on("ftruncate", path).fails()) return -1;
  const int result = next<int(int, off_t)>("ftruncate64")(file, size);
  if (result == 0) record({.name = "resize", .path = path, .size = position(size)});
  return result;
}

/// Its result is the error; errno stays.
int allocate(int file, off_t offset, off_t size) {
  const int before = errno;
  const std::string path = path_of(file);
  const Fault fault = next_fault("fallocate", path);
  if (fault.fails()) return fault.error;
  const int result = next<int(int, off_t, off_t)>("posix_fallocate64")(file, offset, size);
  if (result == 0) record({.name = "resize", .path = path, .size = size_of(file)});
  errno = before;
  return result;
}

using Map = void*(void*, std::size_t, int, int, int, off_t);

void* map(void* at, std::size_t size, int protection, int flags, int file, off_t offset) {
  const std::string path = file >= 0 ? path_of(file) : std::string();
  if (on("mmap", path).fails()) return MAP_FAILED;
  void* const out = next<Map>("mmap64")(at, size, protection, flags, file, offset);
  const bool writes = (protection & PROT_WRITE) != 0 && (flags & MAP_SHARED) != 0;
  if (out == MAP_FAILED || !writes || !is_watched(path)) return out;
  const std::lock_guard lock(mappings_mutex());
  mappings()[out] = {path, position(offset), size};
  return out;
}

/// What was stored through it is in the file now.
void record_mapping(void* at) {
  const std::optional<Mapping> mapping = forget_mapping(at);
  if (!mapping) return;
  record({.name = "write",
          .path = mapping->path,
          .offset = mapping->offset,
          .size = mapping->size,
          .data = at});
}

/// A call on one path that makes or removes it.
int change(const char* call, const char* event, const char* path) {
  const std::string full = absolute(path);
  if (on(call, full).fails()) return -1;
  const int result = next<int(const char*)>(call)(path);
  if (result == 0) record({.name = event, .path = full});
  return result;
}

}  // namespace
}  // namespace mw::faults

using namespace mw::faults;  // NOLINT(google-build-using-namespace): below are C functions

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = va_arg(rest, mode_t);
  va_end(rest);
  return open_file("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = va_arg(rest, mode_t);
  va_end(rest);
  return open_file("open64", path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
  if (on("fopen", absolute(path)).fails()) return nullptr;
  return next<FILE*(const char*, const char*)>("fopen")(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  if (on("fopen", absolute(path)).fails()) return nullptr;
  return next<FILE*(const char*, const char*)>("fopen64")(path, mode);
}

int mkostemp(char* pattern, int flags) {
  if (on("mkostemp", absolute(pattern)).fails()) return -1;
  return next<int(char*, int)>("mkostemp")(pattern, flags);
}

ssize_t write(int file, const void* data, std::size_t size) {
  const Fault fault = on("write", path_of(file));
  if (fault.fails()) return -1;
  const off_t offset = ::lseek(file, 0, SEEK_CUR);
  const ssize_t wrote =
      next<ssize_t(int, const void*, std::size_t)>("write")(file, data, cut(fault, size));
  record_write(file, data, wrote, offset);
  return wrote;
}

ssize_t read(int file, void* data, std::size_t size) {
  const Fault fault = on("read", path_of(file));
  if (fault.fails()) return -1;
  return next<ssize_t(int, void*, std::size_t)>("read")(file, data, cut(fault, size));
}

ssize_t pwrite(int file, const void* data, std::size_t size, off_t offset) {
  return write_at(file, data, size, offset);
}
ssize_t pwrite64(int file, const void* data, std::size_t size, off_t offset) {
  return write_at(file, data, size, offset);
}
ssize_t pread(int file, void* data, std::size_t size, off_t offset) {
  return read_at(file, data, size, offset);
}
ssize_t pread64(int file, void* data, std::size_t size, off_t offset) {
  return read_at(file, data, size, offset);
}

int fsync(int file) {
  return sync("fsync", file);
}
int fdatasync(int file) {
  return sync("fdatasync", file);
}
int ftruncate(int file, off_t size) noexcept {
  return resize(file, size);
}
int ftruncate64(int file, off_t size) noexcept {
  return resize(file, size);
}
int posix_fallocate(int file, off_t offset, off_t size) {
  return allocate(file, offset, size);
}
int posix_fallocate64(int file, off_t offset, off_t size) {
  return allocate(file, offset, size);
}

void* mmap(void* at, std::size_t size, int protection, int flags, int file, off_t offset) noexcept {
  return map(at, size, protection, flags, file, offset);
}
void* mmap64(void* at, std::size_t size, int protection, int flags, int file,
             off_t offset) noexcept {
  return map(at, size, protection, flags, file, offset);
}
int munmap(void* at, std::size_t size) noexcept {
  record_mapping(at);
  return next<int(void*, std::size_t)>("munmap")(at, size);
}

int rename(const char* from, const char* to) noexcept {
  const std::string full = absolute(from);
  if (on("rename", full).fails()) return -1;
  const int result = next<int(const char*, const char*)>("rename")(from, to);
  if (result == 0) record({.name = "rename", .path = full, .other = absolute(to)});
  return result;
}
int mkdir(const char* path, mode_t mode) noexcept {
  const std::string full = absolute(path);
  if (on("mkdir", full).fails()) return -1;
  return next<int(const char*, mode_t)>("mkdir")(path, mode);
}
int unlink(const char* path) noexcept {
  return change("unlink", "unlink", path);
}
int remove(const char* path) noexcept {
  return change("remove", "unlink", path);
}
int rmdir(const char* path) noexcept {
  return change("rmdir", "rmdir", path);
}

}  // extern "C"
