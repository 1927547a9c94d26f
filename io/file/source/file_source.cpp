// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files as ByteSources, read with pread.
#include "io/file/source/file_source.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "io/file/errors.h"
#include "io/file/file_descriptor.h"

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

/// A file that is not opened because too many are open is no bad input.
[[noreturn]] void fail_open(const std::string& name, int error) {
  const std::string why = "cannot open: " + describe(error);
  if (error != EMFILE && error != ENFILE) fail_input(name, {}, why, "check the path");
  throw Error(ErrorKind::kResource, name + ": " + why + "; raise ulimit -n");
}

}  // namespace

FileSource::FileSource(const std::filesystem::path& path)
    : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)), name_(path.string()) {
  if (!file_.valid()) fail_open(name_, errno);
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

JoinedFiles::JoinedFiles(std::vector<std::filesystem::path> files, std::int64_t skip,
                         std::uint64_t piece_bytes, std::string name)
    : files_(std::move(files)), skip_(skip), piece_bytes_(piece_bytes), name_(std::move(name)) {
  for (const std::filesystem::path& path : files_) {
    static_cast<void>(first_byte(FileSource(path)));
  }
}

std::uint64_t JoinedFiles::first_byte(const ByteSource& file) const {
  const std::uint64_t front = skip_ < 0 ? 0 : static_cast<std::uint64_t>(skip_);
  if (file.size() < front || file.size() - front < piece_bytes_) {
    fail_input(file.name(), "voxel data",
               text("needs ", piece_bytes_, " bytes after offset ", front, ", the file holds ",
                    file.size()),
               "the file is truncated or the shape or type is wrong");
  }
  return skip_ < 0 ? file.size() - piece_bytes_ : front;
}

void JoinedFiles::read_at(std::uint64_t offset, std::span<std::byte> out) const {
  while (!out.empty()) {
    const std::uint64_t number = offset / piece_bytes_;
    const std::uint64_t inside = offset % piece_bytes_;
    if (number >= files_.size()) fail_input(name_, "voxel data", "read behind the last file");
    const FileSource file(files_[number]);
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), piece_bytes_ - inside));
    file.read_at(first_byte(file) + inside, out.first(count));
    offset += count;
    out = out.subspan(count);
  }
}

std::filesystem::path named_path(const std::filesystem::path& header, std::string_view field,
                                 std::string_view name, bool is_trusted) {
  const std::filesystem::path path(name);
  const bool climbs = std::find(path.begin(), path.end(), "..") != path.end();
  const bool is_none = name.empty() || name.find('\0') != std::string_view::npos;
  if (is_none || (!is_trusted && (path.is_absolute() || climbs))) {
    fail_input(header.string(), field, text("'", name, "' leads out of the header's folder"),
               "put it beside the header and name it without a path, or give --trust-paths where a "
               "volume's header is to be trusted");
  }
  return header.parent_path() / path;
}

std::filesystem::path named_beside(const std::filesystem::path& header, std::string_view field,
                                   std::string_view name, bool is_trusted) {
  std::filesystem::path path = named_path(header, field, name, is_trusted);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    fail_input(header.string(), field, text(path.string(), " is missing or not a file"),
               "put it where the header says, relative to the header");
  }
  return path;
}

}  // namespace mw::io
