// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Goes on with pread and pwrite until all is done.
#include "io/file/file_descriptor.h"

#include <unistd.h>

#include <cerrno>

namespace mw::io {
namespace {

/// Repeats call until `size` bytes are done.  call takes a place in the bytes and returns, as
/// pread() does, how many it did: 0 at the end, a negative number with errno.
template <class Call>
Transfer repeat(std::size_t size, Call call) {
  Transfer done;
  while (done.bytes < size) {
    const ssize_t count = call(done.bytes);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) done.error = errno;
    if (count <= 0) break;
    done.bytes += static_cast<std::size_t>(count);
  }
  return done;
}

}  // namespace

Transfer read_all(int file, std::uint64_t offset, std::span<std::byte> out) {
  return repeat(out.size(), [&](std::size_t at) {
    return ::pread(file, out.data() + at, out.size() - at, static_cast<off_t>(offset + at));
  });
}

Transfer write_all(int file, std::uint64_t offset, std::span<const std::byte> bytes) {
  Transfer done = repeat(bytes.size(), [&](std::size_t at) {
    return ::pwrite(file, bytes.data() + at, bytes.size() - at, static_cast<off_t>(offset + at));
  });
  if (done.error == 0 && done.bytes < bytes.size()) done.error = EIO;
  return done;
}

}  // namespace mw::io
