// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A file as a ByteSource, read with pread.
#include "io/file/file_source.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "io/file/errors.h"
#include "io/file/whole_calls.h"

namespace mw::io {
namespace {

std::string describe(int error_number) {
  return std::generic_category().message(error_number);
}

[[noreturn]] void fail_short(const FileSource& source, std::uint64_t offset, std::size_t length) {
  fail_input(source.name(), {},
             "expected " + std::to_string(length) + " bytes at offset " + std::to_string(offset) +
                 ", but the file ends at " + std::to_string(source.size()),
             "the file is truncated: get a whole copy");
}

}  // namespace

FileSource::FileSource(const std::filesystem::path& path)
    : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)), name_(path.string()) {
  if (!file_.valid()) fail_input(name_, {}, "cannot open: " + describe(errno), "check the path");
  struct stat facts {};
  if (::fstat(file_.get(), &facts) != 0) fail_input(name_, {}, "cannot stat: " + describe(errno));
  if (S_ISDIR(facts.st_mode)) fail_input(name_, {}, "is a folder", "give a file");
  if (!S_ISREG(facts.st_mode)) {
    fail_input(name_, {}, "is not a regular file", "copy its content to a file first");
  }
  size_ = static_cast<std::uint64_t>(facts.st_size);
}

void FileSource::read_at(std::uint64_t offset, std::span<std::byte> out) const {
  if (offset > size_ || out.size() > size_ - offset) fail_short(*this, offset, out.size());
  const Transfer done = read_all(file_.get(), offset, out);
  if (done.error != 0) {
    fail_input(name_, {},
               "cannot read " + std::to_string(out.size()) + " bytes at offset " +
                   std::to_string(offset) + ": " + describe(done.error),
               "check the disk");
  }
  // The file was cut after it was opened.
  if (done.bytes < out.size()) fail_short(*this, offset, out.size());
}

std::vector<std::byte> read_prefix(const ByteSource& source, std::size_t length) {
  std::vector<std::byte> bytes(source.size_within(length));
  source.read_at(0, bytes);
  return bytes;
}

std::optional<std::string> read_whole(const ByteSource& source, std::uint64_t max) {
  const std::uint64_t size = source.size_within(max + 1);
  if (size > max) return std::nullopt;
  std::string content(size, '\0');
  source.read_at(0, std::as_writable_bytes(std::span(content)));
  return content;
}

}  // namespace mw::io
