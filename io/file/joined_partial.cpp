// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/file/joined_partial.h"

#include <fcntl.h>

#include <cerrno>

#include "io/file/errors.h"
#include "io/file/whole_calls.h"

namespace mw::io {

JoinedPartial::JoinedPartial(const std::filesystem::path& partial)
    : path_(partial), file_(::open(partial.c_str(), O_WRONLY | O_CLOEXEC)) {
  if (!file_.valid()) fail_output(path_.string(), "open", errno);
}

void JoinedPartial::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  const Transfer done = write_all(file_.get(), offset, bytes);
  if (done.error != 0) fail_output(path_.string(), "write", done.error);
}

void JoinedPartial::sync() {
  if (::fsync(file_.get()) != 0) fail_output(path_.string(), "sync", errno);
}

}  // namespace mw::io
