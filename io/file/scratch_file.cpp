// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A buffer in front of a nameless file.
#include "io/file/scratch_file.h"

#include "kernels/core/assert.h"

namespace mw::io {
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
