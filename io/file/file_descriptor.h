// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An owned file descriptor, and pread and pwrite that go on until all is done, since the system may
// do less, and signals interrupt it.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace mw::io {

class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }

  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] bool valid() const { return fd_ >= 0; }

 private:
  int fd_ = -1;
};

/// What a read or write did.
struct Transfer {
  std::size_t bytes =
      0;          ///< fewer than asked for after an error, and where a file that is read ends
  int error = 0;  ///< an errno, or 0
};

/// Read and write an open descriptor.  Thread safety: any, as far as the bytes are apart.
[[nodiscard]] Transfer read_all(int file, std::uint64_t offset, std::span<std::byte> out);
[[nodiscard]] Transfer write_all(int file, std::uint64_t offset, std::span<const std::byte> bytes);

}  // namespace mw::io
