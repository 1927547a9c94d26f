// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Memory that two processes share, under a name until both have it.
#include "engine/codt/wire.h"

#include <fcntl.h>
#include <unistd.h>
#include <boost/interprocess/shared_memory_object.hpp>

#include <atomic>
#include <cerrno>

#include "kernels/core/error.h"

namespace mw::engine::codt {
namespace {

namespace ipc = boost::interprocess;

/// Returns a name that differs from every other name of this process.
std::string next_name() {
  static std::atomic<std::uint64_t> count = 0;
  return "mwmesh-" + std::to_string(::getpid()) + "-" + std::to_string(++count);
}

[[noreturn]] void fail(std::size_t bytes, int reason) {
  throw Error(ErrorKind::kResource, "cannot share " + std::to_string(bytes) +
                                        " bytes of memory with a worker (/dev/shm): " +
                                        std::strerror(reason));  // NOLINT(concurrency-mt-unsafe)
}

/// Reserves bytes of a file, also when signals come in.  Returns 0, or the reason why not.
int reserve(int file, std::size_t bytes) {
  int reason = EINTR;
  while (reason == EINTR) reason = ::posix_fallocate(file, 0, static_cast<off_t>(bytes));
  return reason;
}

}  // namespace

SharedMemory SharedMemory::create(std::size_t bytes) {
  SharedMemory out;
  out.name_ = next_name();
  ipc::shared_memory_object::remove(out.name_.c_str());  // left by a dead process with this id
  try {
    ipc::permissions own;
    own.set_permissions(0600);
    ipc::shared_memory_object memory(ipc::create_only, out.name_.c_str(), ipc::read_write, own);
    if (const int reason = reserve(memory.get_mapping_handle().handle, bytes); reason != 0) {
      out.remove_name();
      fail(bytes, reason);
    }
    out.region_ = ipc::mapped_region(memory, ipc::read_write);
  } catch (const ipc::interprocess_exception& e) {
    out.remove_name();
    fail(bytes, e.get_native_error());
  }
  return out;
}

SharedMemory SharedMemory::open(const std::string& name) {
  SharedMemory out;
  out.name_ = name;
  try {
    const ipc::shared_memory_object memory(ipc::open_only, name.c_str(), ipc::read_write);
    out.region_ = ipc::mapped_region(memory, ipc::read_write);
  } catch (const ipc::interprocess_exception& e) {
    throw Error(ErrorKind::kInternal, "no shared memory " + name + ": " + e.what());
  }
  return out;
}

void SharedMemory::remove_name() const {
  ipc::shared_memory_object::remove(name_.c_str());
}

}  // namespace mw::engine::codt
